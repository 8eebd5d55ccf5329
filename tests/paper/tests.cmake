df_room(paper LIBRARIES dynamic_filter)
