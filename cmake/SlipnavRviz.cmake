# The operator's panel, an rviz plugin. Without rviz to build against, everything else is still built.

find_package(rviz QUIET)
find_package(Qt5Widgets QUIET)
file(GLOB rviz_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/panel/*.cpp" "${PROJECT_SOURCE_DIR}/src/panel/*.h")
if(rviz_FOUND AND Qt5Widgets_FOUND AND TARGET slipnav_ros)
  add_library(slipnav_rviz SHARED ${rviz_sources})
  slipnav_configure_target(slipnav_rviz)
  set_target_properties(slipnav_rviz PROPERTIES AUTOMOC ON INSTALL_RPATH "$ORIGIN")
  # boost's signals and Qt's keywords do not go together.
  target_compile_definitions(slipnav_rviz PRIVATE QT_NO_KEYWORDS)
  #catkin_lint: ignore_once external_interface_path
  target_include_directories(slipnav_rviz SYSTEM PUBLIC ${rviz_INCLUDE_DIRS} ${Qt5Widgets_INCLUDE_DIRS})
  target_link_libraries(slipnav_rviz PUBLIC slipnav_ros ${rviz_LIBRARIES} ${Qt5Widgets_LIBRARIES})
  install(TARGETS slipnav_rviz
    ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
  install(FILES rviz_plugins.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
endif()
