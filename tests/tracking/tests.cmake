df_room(tracking LIBRARIES dynamic_filter)
