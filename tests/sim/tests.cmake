df_room(sim LIBRARIES dynamic_filter_sim)
