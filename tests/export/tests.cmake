df_room(export LIBRARIES dynamic_filter_app)
