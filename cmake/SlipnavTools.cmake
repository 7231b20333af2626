# Executables: src/tools/X.cpp is started by `rosrun slipnav X`, or lies in bin/ of a core-only build.

# Those that need no ROS; every other one links slipnav_ros.
set(core_tools configuration forecast positions)

# Target names are shared by a whole workspace, so they carry the package's name; the file does not.
function(slipnav_add_tool source)
  get_filename_component(name "${source}" NAME_WE)
  add_executable(slipnav_${name} "${source}")
  slipnav_configure_target(slipnav_${name})
  target_link_libraries(slipnav_${name} PRIVATE ${ARGN})
  set_target_properties(slipnav_${name} PROPERTIES OUTPUT_NAME ${name} INSTALL_RPATH "$ORIGIN/..")
  if(SLIPNAV_CORE_ONLY)
    set_target_properties(slipnav_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
  else()
    install(TARGETS slipnav_${name} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
  endif()
endfunction()

# Worlds and grades of an uninstalled build.
set_source_files_properties("${PROJECT_SOURCE_DIR}/src/tools/simulate.cpp" PROPERTIES
  COMPILE_DEFINITIONS "SLIPNAV_CONFIG_DIR=\"${PROJECT_SOURCE_DIR}/config\"")

file(GLOB tool_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/tools/*.cpp")
foreach(source IN LISTS tool_sources)
  get_filename_component(name "${source}" NAME_WE)
  if(name IN_LIST core_tools)
    slipnav_add_tool("${source}" ${slipnav_layer_libraries})
  elseif(TARGET slipnav_ros)
    slipnav_add_tool("${source}" slipnav_ros)
  endif()
endforeach()
