df_room(recording LIBRARIES dynamic_filter_app)
target_compile_definitions(recording_test PRIVATE FORMATS_PAGE="${PROJECT_SOURCE_DIR}/docs/formats.md")
