df_room(objects LIBRARIES dynamic_filter_app)
