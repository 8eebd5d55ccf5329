foreach(unit bodies caster city_actors city_parking city_route crowd facade lidar mesh obstacles path people portable props prototypes
             random scene_city scene_crowd scene_hall scene_square scene_jam scene_platform scene_street scenes sensors signal
             simulation social_force traffic voxel_share)
  df_test(sim/${unit} dynamic_filter_sim embree)
  target_include_directories(sim_${unit}_test PRIVATE ${PROJECT_SOURCE_DIR}/src)
endforeach()
