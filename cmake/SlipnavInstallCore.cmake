# Without ROS the core is installed as a package of plain CMake: find_package(slipnav) and slipnav::core.

include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(config_folder "${CMAKE_INSTALL_LIBDIR}/cmake/slipnav")
set_target_properties(slipnav_core PROPERTIES EXPORT_NAME core)
#catkin_lint: ignore_once wrong_install_destination
install(TARGETS slipnav_core EXPORT slipnav COMPONENT core
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
#catkin_lint: ignore_once wrong_install_destination
install(DIRECTORY include/slipnav DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT core FILES_MATCHING PATTERN "*.h")
install(EXPORT slipnav NAMESPACE slipnav:: FILE slipnavTargets.cmake DESTINATION "${config_folder}" COMPONENT core)

configure_package_config_file(cmake/slipnavConfig.cmake.in "${PROJECT_BINARY_DIR}/slipnavConfig.cmake"
  INSTALL_DESTINATION "${config_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/slipnavConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
#catkin_lint: ignore_once wrong_install_destination missing_file
install(FILES "${PROJECT_BINARY_DIR}/slipnavConfig.cmake" "${PROJECT_BINARY_DIR}/slipnavConfigVersion.cmake"
  DESTINATION "${config_folder}" COMPONENT core)
