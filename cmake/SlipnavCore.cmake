# slipnav_core, slipnav_simulation, ...: one library for each layer below ROS, of src/LAYER. The headers that all compile
# first are compiled once, for the core.

foreach(layer IN LISTS slipnav_layers)
  file(GLOB_RECURSE ${layer}_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/${layer}/*.cpp")
  add_library(slipnav_${layer} SHARED ${${layer}_sources})
  slipnav_configure_target(slipnav_${layer})
  slipnav_refuse_undefined_symbols(slipnav_${layer})
  # A macro named after each library would make the compiled headers differ.
  set_target_properties(slipnav_${layer} PROPERTIES DEFINE_SYMBOL "" INSTALL_RPATH "$ORIGIN")
  if(layer STREQUAL "core")
    target_precompile_headers(slipnav_core PRIVATE ${SLIPNAV_COMMON_HEADERS})
  else()
    target_precompile_headers(slipnav_${layer} REUSE_FROM slipnav_core)
  endif()
  foreach(used IN LISTS slipnav_uses_${layer})
    target_link_libraries(slipnav_${layer} PUBLIC slipnav_${used})
  endforeach()
endforeach()

target_include_directories(slipnav_core PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>")
#catkin_lint: ignore_once external_interface_path
target_include_directories(slipnav_core SYSTEM PUBLIC ${GeographicLib_INCLUDE_DIRS} PRIVATE ${NLOPT_INCLUDE_DIR})
target_link_libraries(slipnav_core
  PUBLIC Eigen3::Eigen Threads::Threads ${GeographicLib_LIBRARIES}
  PRIVATE ${NLOPT_LIBRARY})
target_link_libraries(slipnav_config PUBLIC ${YAML_CPP_LIBRARIES})
#catkin_lint: ignore_once external_interface_path
target_include_directories(slipnav_tuning SYSTEM PRIVATE ${NLOPT_INCLUDE_DIR})
target_link_libraries(slipnav_tuning PRIVATE ${NLOPT_LIBRARY})
