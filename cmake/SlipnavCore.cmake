# slipnav_core: everything under src/ except the folders that know ROS or hold a main().

find_package(Eigen3 3.3 REQUIRED NO_MODULE)
list(APPEND CMAKE_MODULE_PATH /usr/share/cmake/geographiclib)
find_package(GeographicLib REQUIRED)
find_package(yaml-cpp REQUIRED)
find_path(NLOPT_INCLUDE_DIR nlopt.hpp)
find_library(NLOPT_LIBRARY NAMES nlopt_cxx nlopt)
if(NOT NLOPT_INCLUDE_DIR OR NOT NLOPT_LIBRARY)
  message(FATAL_ERROR "slipnav: NLopt with its C++ header was not found (package libnlopt-cxx-dev)")
endif()

file(GLOB_RECURSE core_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/*.cpp")
list(FILTER core_sources EXCLUDE REGEX "/src/(ros|nodelets|tools)/")

add_library(slipnav_core SHARED ${core_sources})
slipnav_configure_target(slipnav_core)
target_include_directories(slipnav_core PUBLIC "${PROJECT_SOURCE_DIR}/include")
#catkin_lint: ignore_once external_interface_path
target_include_directories(slipnav_core SYSTEM PUBLIC ${GeographicLib_INCLUDE_DIRS} ${NLOPT_INCLUDE_DIR})
target_link_libraries(slipnav_core
  PUBLIC Eigen3::Eigen ${GeographicLib_LIBRARIES} ${YAML_CPP_LIBRARIES}
  PRIVATE ${NLOPT_LIBRARY})
