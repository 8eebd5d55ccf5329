df_room(page LIBRARIES dynamic_filter_app)
