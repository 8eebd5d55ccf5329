df_room(navigation LIBRARIES dynamic_filter_io)
