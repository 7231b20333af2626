# Language level, optimisation, warnings and sanitizers of this package's own targets.
#
# Results must be equal bit for bit across machines and builds. Hence no -march=native, no -ffast-math, and no fused
# multiply-add that the compiler would otherwise form wherever the target has one.

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif()

find_program(SLIPNAV_CCACHE ccache)
if(SLIPNAV_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${SLIPNAV_CCACHE}")
endif()

if(SLIPNAV_CLANG_TIDY)
  find_program(SLIPNAV_CLANG_TIDY_PROGRAM clang-tidy)
  if(NOT SLIPNAV_CLANG_TIDY_PROGRAM)
    message(FATAL_ERROR "slipnav: SLIPNAV_CLANG_TIDY is on, but clang-tidy was not found")
  endif()
endif()

# Applies the above to one target of this package.
function(slipnav_configure_target target)
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
  if(SLIPNAV_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(SLIPNAV_SANITIZE)
    # GCC takes the sanitizers' own code for uninitialised use, in Eigen above all.
    target_compile_options(${target} PRIVATE
      $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
      -fsanitize=${SLIPNAV_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${SLIPNAV_SANITIZE})
  endif()
  if(SLIPNAV_CLANG_TIDY)
    set_target_properties(${target} PROPERTIES CXX_CLANG_TIDY "${SLIPNAV_CLANG_TIDY_PROGRAM};--quiet")
  endif()
endfunction()
