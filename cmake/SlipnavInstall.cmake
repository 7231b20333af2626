# Install rules. Executables install themselves in SlipnavTools.

set(installed_libraries ${slipnav_layer_libraries})
foreach(library slipnav_ros slipnav_nodelets)
  if(TARGET ${library})
    list(APPEND installed_libraries ${library})
  endif()
endforeach()
install(TARGETS ${installed_libraries}
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})

install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION} FILES_MATCHING PATTERN "*.h")
install(DIRECTORY config launch rviz urdf DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(FILES nodelet_plugins.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})

file(GLOB python_scripts CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/scripts/*.py")
if(python_scripts)
  #catkin_lint: ignore_once argument_error
  catkin_install_python(PROGRAMS ${python_scripts}
    DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
  install(DIRECTORY scripts/slipnav_campaign scripts/slipnav_drives scripts/slipnav_import scripts/slipnav_report
    scripts/slipnav_tables scripts/slipnav_zoo DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION}
    FILES_MATCHING PATTERN "*.py" PATTERN "*.js" PATTERN "*.css")
endif()
