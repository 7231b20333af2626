# catkin and the ament macros behind pluginlib take the first python3 of PATH. Where that one lacks catkin_pkg and the
# system's has it, the system's is taken.

function(slipnav_has_catkin_pkg python result)
  execute_process(COMMAND "${python}" -c "import catkin_pkg" RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
  if(status EQUAL 0)
    set(${result} TRUE PARENT_SCOPE)
  else()
    set(${result} FALSE PARENT_SCOPE)
  endif()
endfunction()

function(slipnav_choose_python)
  if(PYTHON_EXECUTABLE OR NOT EXISTS /usr/bin/python3)
    return()
  endif()
  slipnav_has_catkin_pkg(python3 first_will_do)
  slipnav_has_catkin_pkg(/usr/bin/python3 system_will_do)
  if(system_will_do AND NOT first_will_do)
    message(STATUS "slipnav: the first python3 of PATH has no catkin_pkg, taking /usr/bin/python3")
    set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python with catkin_pkg")
    set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python with catkin_pkg")
  endif()
endfunction()
