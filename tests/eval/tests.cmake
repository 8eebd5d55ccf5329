df_room(eval LIBRARIES dynamic_filter_eval)
