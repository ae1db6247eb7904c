# Sets CALLIGRAPHY_SOURCE_COMMIT to the commit of the source, with -dirty if files that git tracks differ, and to
# "unknown" unless the source is a git checkout of its own. CMake runs again when another commit is checked out.
set(CALLIGRAPHY_SOURCE_COMMIT unknown)
find_package(Git QUIET)
if(NOT GIT_FOUND)
  return()
endif()
foreach(asked "top:rev-parse;--show-toplevel" "commit:describe;--always;--dirty;--abbrev=40;--exclude=*"
              "log:rev-parse;--git-path;logs/HEAD")
  string(REGEX REPLACE ":.*" "" answer "${asked}")
  string(REGEX REPLACE "^[a-z]*:" "" asked "${asked}")
  execute_process(COMMAND ${GIT_EXECUTABLE} ${asked} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE ${answer}
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failure)
  if(failure)
    return()
  endif()
endforeach()
file(REAL_PATH "${PROJECT_SOURCE_DIR}" source)
file(REAL_PATH "${top}" top)
if(NOT top STREQUAL source)  # a copy within the checkout of something else
  return()
endif()
set(CALLIGRAPHY_SOURCE_COMMIT ${commit})
get_filename_component(log "${log}" ABSOLUTE BASE_DIR ${PROJECT_SOURCE_DIR})
if(EXISTS "${log}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${log}")
endif()
