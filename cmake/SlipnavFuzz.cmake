# Fuzz targets of test/fuzz, built on demand only: with libFuzzer where the compiler has it, otherwise with a driver that
# changes inputs of the corpus at random. Targets named *_ros_fuzz need ROS.

option(SLIPNAV_FUZZ "Build the fuzz targets; sanitizers are chosen by SLIPNAV_SANITIZE" OFF)

if(SLIPNAV_FUZZ)
  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_FLAGS -fsanitize=fuzzer)
  check_cxx_source_compiles("extern \"C\" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }"
    SLIPNAV_HAS_LIBFUZZER)
  unset(CMAKE_REQUIRED_FLAGS)

  add_custom_target(slipnav_fuzz)
  file(GLOB fuzz_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/test/fuzz/*_fuzz.cpp")
  foreach(source IN LISTS fuzz_sources)
    get_filename_component(name "${source}" NAME_WE)
    set(libraries ${slipnav_layer_libraries})
    if(name MATCHES "_ros_fuzz$")
      set(libraries slipnav_ros)
    endif()
    list(GET libraries 0 first_library)
    if(TARGET ${first_library})
      add_executable(slipnav_${name} EXCLUDE_FROM_ALL
        "${source}" "${PROJECT_SOURCE_DIR}/test/fuzz/limited_memory.cpp")
      slipnav_configure_target(slipnav_${name})
      target_include_directories(slipnav_${name} PRIVATE "${PROJECT_SOURCE_DIR}/test/support")
      target_link_libraries(slipnav_${name} PRIVATE ${libraries})
      if(SLIPNAV_HAS_LIBFUZZER)
        target_compile_options(slipnav_${name} PRIVATE -fsanitize=fuzzer)
        target_link_options(slipnav_${name} PRIVATE -fsanitize=fuzzer)
      else()
        target_sources(slipnav_${name} PRIVATE "${PROJECT_SOURCE_DIR}/test/fuzz/random_mutation_main.cpp")
      endif()
      add_dependencies(slipnav_fuzz slipnav_${name})
    endif()
  endforeach()
endif()
