df_room(check LIBRARIES dynamic_filter_app SHARED Check Stamps)  # on simulated recordings
