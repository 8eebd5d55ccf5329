df_room(draw LIBRARIES dynamic_filter_app PNG::PNG)
