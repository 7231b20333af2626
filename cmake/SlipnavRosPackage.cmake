# Everything catkin needs to know before the first target: components, messages and what the package exports.

find_package(catkin REQUIRED COMPONENTS
  diagnostic_msgs
  diagnostic_updater
  dynamic_reconfigure
  geometry_msgs
  message_generation
  nav_msgs
  nodelet
  pluginlib
  rosbag
  rosbag_storage
  roscpp
  rosgraph_msgs
  sensor_msgs
  std_msgs
  std_srvs
  tf2
  tf2_eigen
  tf2_geometry_msgs
  tf2_msgs
  tf2_ros
  visualization_msgs
)
find_package(Boost REQUIRED)

file(GLOB message_files CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/msg" "${PROJECT_SOURCE_DIR}/msg/*.msg")
file(GLOB service_files CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/srv" "${PROJECT_SOURCE_DIR}/srv/*.srv")
if(message_files)
  add_message_files(DIRECTORY msg FILES ${message_files})
endif()
if(service_files)
  add_service_files(DIRECTORY srv FILES ${service_files})
endif()
if(message_files OR service_files)
  generate_messages(DEPENDENCIES geometry_msgs std_msgs)
endif()

file(GLOB_RECURSE ros_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/ros/*.cpp")
file(GLOB nodelet_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/nodelets/*.cpp")
set(exported_libraries ${slipnav_layer_libraries})
if(ros_sources)
  list(APPEND exported_libraries slipnav_ros)
endif()

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES ${exported_libraries}
  CATKIN_DEPENDS
    diagnostic_msgs
    dynamic_reconfigure
    geometry_msgs
    message_runtime
    nav_msgs
    nodelet
    roscpp
    rosgraph_msgs
    sensor_msgs
    std_msgs
    std_srvs
    tf2_ros
    visualization_msgs
  DEPENDS EIGEN3 GeographicLib YAML_CPP
  CFG_EXTRAS slipnav-targets.cmake
)
