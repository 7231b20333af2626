# Benchmarks of test/bench in one executable, where Google Benchmark is installed; built on demand only.

file(GLOB benchmark_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/test/bench/*.cpp")
find_package(benchmark QUIET)
if(benchmark_FOUND AND benchmark_sources)
  #catkin_lint: skip
  add_executable(slipnav_benchmarks EXCLUDE_FROM_ALL ${benchmark_sources} ${support_sources})
  slipnav_configure_target(slipnav_benchmarks)
  target_include_directories(slipnav_benchmarks PRIVATE "${test_folder}" "${test_folder}/support")
  target_compile_definitions(slipnav_benchmarks PRIVATE SLIPNAV_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(slipnav_benchmarks PRIVATE ${slipnav_layer_libraries} benchmark::benchmark benchmark::benchmark_main)
endif()
