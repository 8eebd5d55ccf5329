df_room(check LIBRARIES dynamic_filter_app SHARED Check CompareDrives RecordedMotion Stamps)  # on simulated recordings
