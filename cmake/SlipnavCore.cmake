# slipnav_core: everything under src/ except the folders that know ROS or hold a main().

file(GLOB_RECURSE core_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/*.cpp")
list(FILTER core_sources EXCLUDE REGEX "/src/(ros|nodelets|rviz|tools)/")

add_library(slipnav_core SHARED ${core_sources})
slipnav_configure_target(slipnav_core)
target_precompile_headers(slipnav_core PRIVATE ${SLIPNAV_COMMON_HEADERS})
target_include_directories(slipnav_core PUBLIC "${PROJECT_SOURCE_DIR}/include")
#catkin_lint: ignore_once external_interface_path
target_include_directories(slipnav_core SYSTEM PUBLIC ${GeographicLib_INCLUDE_DIRS} PRIVATE ${NLOPT_INCLUDE_DIR})
target_link_libraries(slipnav_core
  PUBLIC Eigen3::Eigen ${GeographicLib_LIBRARIES} ${YAML_CPP_LIBRARIES}
  PRIVATE ${NLOPT_LIBRARY} Threads::Threads)
