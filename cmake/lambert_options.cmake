# Flags that every target shares, and helpers to declare a room (one target a folder).

find_program(CCACHE ccache)
if(CCACHE)
  # Paths relative to the checkout: what one checkout compiled, another finds.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} ${CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})
endif()

option(LAMBERT_WERROR "Treat warnings as errors" OFF)
set(LAMBERT_SANITIZE "" CACHE STRING "address,undefined or thread; empty: none")

add_library(lambert_flags INTERFACE)
target_include_directories(lambert_flags INTERFACE ${PROJECT_SOURCE_DIR})
# The same bits on every machine: no contraction to FMA, no fast-math; AVX2 is the pinned baseline.
target_compile_options(lambert_flags INTERFACE
  -march=x86-64-v3 -ffp-contract=off -fno-math-errno -Wall -Wextra -Wno-unused-parameter
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # gcc 12 sees one in every "text" + std::string (GCC bug 105329)
  $<$<BOOL:${LAMBERT_WERROR}>:-Werror>)
if(LAMBERT_SANITIZE)
  target_compile_options(lambert_flags INTERFACE -fsanitize=${LAMBERT_SANITIZE}
    -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(lambert_flags INTERFACE -fsanitize=${LAMBERT_SANITIZE})
endif()

# lambert_room(NAME SOURCES ... PUBLIC ... PRIVATE ...): static library lambert_NAME.
function(lambert_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(lambert_${name} STATIC ${ROOM_SOURCES})
  target_link_libraries(lambert_${name} PUBLIC lambert_flags ${ROOM_PUBLIC} PRIVATE ${ROOM_PRIVATE})
endfunction()

# lambert_program(NAME SOURCES ... LIBS ...): an installed program with a command line.
function(lambert_program name)
  cmake_parse_arguments(PROGRAM "" "" "SOURCES;LIBS" ${ARGN})
  find_package(CLI11 CONFIG REQUIRED)
  add_executable(${name} ${PROGRAM_SOURCES})
  target_link_libraries(${name} PRIVATE ${PROGRAM_LIBS} CLI11::CLI11)
  install(TARGETS ${name})
endfunction()

# lambert_test(NAME SOURCES ... LIBS ... [LABELS ...]): a GoogleTest program, one ctest entry a test. Under
# ctest, rapidcheck draws the same examples each time.
function(lambert_test name)
  cmake_parse_arguments(TEST "" "" "SOURCES;LIBS;LABELS" ${ARGN})
  add_executable(${name} ${TEST_SOURCES})
  target_link_libraries(${name} PRIVATE lambert_flags ${TEST_LIBS} GTest::gtest_main)
  if(LAMBERT_SANITIZE STREQUAL "thread")
    target_sources(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support/thread_sanitizer.cc)
  endif()
  set(labels)  # an empty value would take the next word, TIMEOUT, for the label
  if(TEST_LABELS)
    set(labels LABELS "${TEST_LABELS}")
  endif()
  gtest_discover_tests(${name} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 300 ENVIRONMENT "RC_PARAMS=seed=1" ${labels})
endfunction()
