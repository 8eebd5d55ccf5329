df_room(settings LIBRARIES dynamic_filter_app)
