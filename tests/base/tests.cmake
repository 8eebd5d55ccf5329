df_room(base LIBRARIES dynamic_filter_app)
