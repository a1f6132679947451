# How everything is compiled.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)  # the stages also go into the Python extension
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug or RelWithDebInfo" FORCE)
endif()

find_package(Threads REQUIRED)

# Public: decoding must give the same bits on every machine (docs/DESIGN.md, "Same bits everywhere"), also where the
# headers' inline arithmetic is compiled into a user's program. So no contraction into fused multiply-adds, and neither
# -ffast-math nor -march=native anywhere.
add_library(pfgeom_options INTERFACE)
target_include_directories(pfgeom_options INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/native>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(pfgeom_options INTERFACE cxx_std_20)
target_compile_options(pfgeom_options INTERFACE -ffp-contract=off)
target_link_libraries(pfgeom_options INTERFACE Threads::Threads)

# Private: for our own sources.
add_library(pfgeom_warnings INTERFACE)
target_compile_options(pfgeom_warnings INTERFACE
    -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wpedantic
    $<$<BOOL:${PFGEOM_WARNINGS_AS_ERRORS}>:-Werror>)
