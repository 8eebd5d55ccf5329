df_room(recording LIBRARIES dynamic_filter_app)
