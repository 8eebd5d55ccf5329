df_room(score LIBRARIES dynamic_filter_eval nlohmann_json::nlohmann_json)
