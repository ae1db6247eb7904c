# Unity builds compile common headers and templates once for several source files. Names in unnamed namespaces must
# therefore be unique within a target. CALLIGRAPHY_UNITY=OFF compiles each file on its own, which detects missing
# includes (scripts/full/each_file.sh).
option(CALLIGRAPHY_UNITY "Unity build: compile several source files as one, in a third of the time" ON)

# calligraphy_unity(target files): compiles up to `files` source files of the target per unit, in units of like size.
function(calligraphy_unity target files)
  get_target_property(sources ${target} SOURCES)
  list(LENGTH sources count)
  math(EXPR units "(${count} + ${files} - 1) / ${files}")
  math(EXPR files "(${count} + ${units} - 1) / ${units}")
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${CALLIGRAPHY_UNITY} UNITY_BUILD_BATCH_SIZE ${files})
endfunction()

# calligraphy_unoptimised_under_sanitizers(target): clang, under sanitizers, takes twice as long to compile with
# optimisation, and the program of a test is mostly compiled. What the program has in common with the library, the
# templates and inline functions, the linker takes from the first file that has it: the library's comes first, which is
# optimised. (test_render: 22 s to compile and 16 to run; with the library last 22 and 70, optimised 52 and 8.)
function(calligraphy_unoptimised_under_sanitizers target)
  if(NOT CALLIGRAPHY_SANITIZE OR NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    return()
  endif()
  target_compile_options(${target} PRIVATE -O0)
  get_target_property(linked ${target} LINK_LIBRARIES)
  list(FILTER linked INCLUDE REGEX "^calligraphy_")
  set(archives "")
  while(linked)
    list(POP_FRONT linked library)
    get_target_property(type ${library} TYPE)
    if(type STREQUAL "STATIC_LIBRARY" AND NOT "$<TARGET_FILE:${library}>" IN_LIST archives)
      list(APPEND archives "$<TARGET_FILE:${library}>")
      string(REGEX REPLACE "^calligraphy_" "" component ${library})
      get_property(below GLOBAL PROPERTY CALLIGRAPHY_${component}_DEPENDS)
      list(TRANSFORM below PREPEND "calligraphy_")
      list(APPEND linked ${below})
    endif()
  endwhile()
  if(archives AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
    list(JOIN archives "," archives)
    target_link_options(${target} PRIVATE "LINKER:--whole-archive,${archives},--no-whole-archive")
  endif()
endfunction()
