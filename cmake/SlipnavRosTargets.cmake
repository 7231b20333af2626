# The ROS side: conversions and nodelets.

if(ros_sources)
  add_library(slipnav_ros SHARED ${ros_sources})
  slipnav_configure_target(slipnav_ros)
  slipnav_refuse_undefined_symbols(slipnav_ros)
  target_precompile_headers(slipnav_ros PRIVATE ${SLIPNAV_COMMON_HEADERS} ${SLIPNAV_ROS_HEADERS})
  # SYSTEM: the warnings above are for this package's own code, not for generated or foreign headers.
  #catkin_lint: ignore_once external_interface_path external_directory
  target_include_directories(slipnav_ros SYSTEM PUBLIC
    "${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION}" ${catkin_INCLUDE_DIRS} ${Boost_INCLUDE_DIRS})
  target_link_libraries(slipnav_ros PUBLIC ${slipnav_layer_libraries} ${catkin_LIBRARIES})
  set_target_properties(slipnav_ros PROPERTIES INSTALL_RPATH "$ORIGIN")
  if(TARGET ${PROJECT_NAME}_generate_messages_cpp)
    add_dependencies(slipnav_ros ${PROJECT_NAME}_generate_messages_cpp)
  endif()

  if(nodelet_sources)
    add_library(slipnav_nodelets SHARED ${nodelet_sources})
    slipnav_configure_target(slipnav_nodelets)
    slipnav_refuse_undefined_symbols(slipnav_nodelets)
    target_precompile_headers(slipnav_nodelets PRIVATE ${SLIPNAV_COMMON_HEADERS} ${SLIPNAV_ROS_HEADERS})
    target_link_libraries(slipnav_nodelets PRIVATE slipnav_ros)
    set_target_properties(slipnav_nodelets PROPERTIES INSTALL_RPATH "$ORIGIN")
  endif()
endif()
