df_room(check LIBRARIES dynamic_filter_app
  SHARED Check ChoosePoses CompareDrives ExplainAlarm MotionLooks RecordedMotion ReplacedPoses ScanTimes Stamps TrackScans)  # on simulated recordings
