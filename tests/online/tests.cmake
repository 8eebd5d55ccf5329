df_room(online LIBRARIES dynamic_filter)
