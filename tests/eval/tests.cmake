foreach(unit point_scores scores voxel_scores)
  df_test(eval/${unit} dynamic_filter_eval)
endforeach()
