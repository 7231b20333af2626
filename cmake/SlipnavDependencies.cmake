# Libraries that the core needs.

find_package(Eigen3 3.3 REQUIRED NO_MODULE)
list(APPEND CMAKE_MODULE_PATH /usr/share/cmake/geographiclib)
find_package(GeographicLib REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(Threads REQUIRED)

find_path(NLOPT_INCLUDE_DIR nlopt.hpp)
find_library(NLOPT_LIBRARY NAMES nlopt_cxx nlopt)
if(NOT NLOPT_INCLUDE_DIR OR NOT NLOPT_LIBRARY)
  message(FATAL_ERROR "slipnav: NLopt with its C++ header was not found (package libnlopt-cxx-dev)")
endif()

# catkin_package(DEPENDS EIGEN3) exports these; Eigen's own package defines only the target.
if(NOT EIGEN3_INCLUDE_DIRS)
  get_target_property(EIGEN3_INCLUDE_DIRS Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
endif()
