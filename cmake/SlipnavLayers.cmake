# The layers below ROS, one library each. A layer links only those that it may include, so that a call upwards is an
# linker error; test/doc/layers_test.py checks the includes against the same order, folder by folder.

set(slipnav_layers core simulation io config evaluation calibration overlay inspection tuning)
set(slipnav_uses_simulation core)
set(slipnav_uses_io core)
set(slipnav_uses_config simulation io)
set(slipnav_uses_evaluation config)
set(slipnav_uses_calibration evaluation)
set(slipnav_uses_overlay evaluation)
set(slipnav_uses_inspection calibration)
set(slipnav_uses_tuning calibration)

foreach(layer IN LISTS slipnav_layers)
  list(APPEND slipnav_layer_libraries slipnav_${layer})
endforeach()
