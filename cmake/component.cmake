# calligraphy_component(name [ONE_UNIT] [C_INTERFACE] [EXPORT set] [FOLDER folder] [SUBFOLDERS ...] [SOURCES ...]
# [WITHOUT ...] DEPENDS ... [NEEDS package ...]): a component as the target calligraphy::name, from the source files in
# src/folder (default src/name) and its SUBFOLDERS except WITHOUT, plus the generated SOURCES. ONE_UNIT: its files are
# compiled as one, so that any function can be inlined. C_INTERFACE: a shared library that exports functions of C alone.
# DEPENDS: components, and libraries that all components need. NEEDS: packages that a user of an installed copy must
# have to link the target.
function(calligraphy_component name)
  cmake_parse_arguments(COMPONENT "ONE_UNIT;C_INTERFACE" "EXPORT;FOLDER" "SUBFOLDERS;SOURCES;WITHOUT;DEPENDS;NEEDS" ${ARGN})
  if(NOT COMPONENT_EXPORT)
    set(COMPONENT_EXPORT calligraphyTargets)
  endif()
  if(NOT COMPONENT_FOLDER)
    set(COMPONENT_FOLDER ${name})
  endif()
  set(patterns src/${COMPONENT_FOLDER}/*.cpp)
  foreach(subfolder ${COMPONENT_SUBFOLDERS})
    list(APPEND patterns src/${COMPONENT_FOLDER}/${subfolder}/*.cpp)
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  foreach(file ${COMPONENT_WITHOUT})
    list(REMOVE_ITEM sources ${PROJECT_SOURCE_DIR}/src/${COMPONENT_FOLDER}/${file})
  endforeach()
  set(target calligraphy_${name})
  if(COMPONENT_C_INTERFACE AND NOT EMSCRIPTEN)  # which exports functions when it links a module
    add_library(${target} SHARED ${sources} ${COMPONENT_SOURCES})
    calligraphy_export_c(${target})
  else()
    add_library(${target} ${sources} ${COMPONENT_SOURCES})
  endif()
  add_library(calligraphy::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
                                       PRIVATE ${PROJECT_SOURCE_DIR}/src)
  if(COMPONENT_C_INTERFACE)  # users need neither C++ nor what it is made of
    target_compile_features(${target} PRIVATE cxx_std_20)
    target_link_libraries(${target} PRIVATE ${COMPONENT_DEPENDS})
  else()
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_link_libraries(${target} PUBLIC ${COMPONENT_DEPENDS})
  endif()
  # Bit-identical results on every processor: no contraction into fused operations.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off>)
  # Nobody reads errno after a square root, or replaces a function of a component at run time: g++ may inline both.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-fno-math-errno>
                                           $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
  calligraphy_warnings(${target})
  if(COMPONENT_ONE_UNIT)
    calligraphy_unity(${target} 1000)
  else()
    calligraphy_unity(${target} 12)
  endif()
  set(components "")
  if(NOT COMPONENT_C_INTERFACE)
    set(components ${COMPONENT_DEPENDS})
  endif()
  list(FILTER components INCLUDE REGEX "^calligraphy_")
  list(TRANSFORM components REPLACE "^calligraphy_" "")
  set_property(GLOBAL APPEND PROPERTY CALLIGRAPHY_COMPONENTS ${name})
  set_property(GLOBAL PROPERTY CALLIGRAPHY_${name}_DEPENDS "${components}")
  set_property(GLOBAL PROPERTY CALLIGRAPHY_${name}_NEEDS "${COMPONENT_NEEDS}")
  install(TARGETS ${target} EXPORT ${COMPONENT_EXPORT})
  set(without "")
  if(name STREQUAL "devices")  # backends install their own headers; PATTERN also excludes the folders themselves
    set(without PATTERN phantom EXCLUDE PATTERN openhaptics EXCLUDE)
  endif()
  set(include_directory ${CMAKE_INSTALL_INCLUDEDIR}/calligraphy/${COMPONENT_FOLDER})
  install(DIRECTORY include/calligraphy/${COMPONENT_FOLDER}/ DESTINATION ${include_directory} ${without})
endfunction()

# calligraphy_embed_languages(variable): generates a source file that defines calligraphy::built_in::languages, from every
# file of data/languages, declared in src/judge/remarks/built_in.hpp. Stops at a line that is no text, or opens a
# brace without closing it, and at a text that a language lacks; it may leave out those for more than one.
function(calligraphy_embed_languages variable)
  set(source ${PROJECT_BINARY_DIR}/built_in_languages.cpp)
  set(content "#include <${PROJECT_SOURCE_DIR}/src/judge/remarks/built_in.hpp>\n\nconst calligraphy::built_in::LanguageFile ")
  string(APPEND content "calligraphy::built_in::languages[] = {\n")
  set(directory ${PROJECT_SOURCE_DIR}/data/languages)
  file(STRINGS ${directory}/en.txt expected REGEX "^[a-z]" ENCODING UTF-8)
  list(TRANSFORM expected REPLACE " = .*" "")
  list(FILTER expected EXCLUDE REGEX "^ordinal\\.|\\.several$")
  file(GLOB files CONFIGURE_DEPENDS ${directory}/*.txt)
  foreach(file ${files})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} text)
    string(REPLACE "\r\n" "\n" text "${text}")
    string(REGEX REPLACE "\n(#[^\n]*|[a-z0-9_.]+ = ([^{} \n]|{[a-z_]+})([^{}\n]|{[a-z_]+})*)?" "" wrong "\n${text}")
    if(wrong)
      message(FATAL_ERROR "${file}: expected lines `key = text` and comments, got `${wrong}`")
    endif()
    foreach(key ${expected})
      string(FIND "\n${text}" "\n${key} = " place)
      if(place EQUAL -1)
        message(FATAL_ERROR "${file}: there is no text for ${key}, which en.txt has")
      endif()
    endforeach()
    get_filename_component(code ${file} NAME_WLE)
    string(APPEND content "{\"${code}\", R\"calligraphy(${text})calligraphy\"},\n")
  endforeach()
  string(APPEND content "{nullptr, nullptr}};\n")
  file(CONFIGURE OUTPUT ${source} CONTENT "@content@" @ONLY)
  set(${variable} ${source} PARENT_SCOPE)
endfunction()

function(calligraphy_warnings target)
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall -Wextra -Wpedantic -Wconversion -Wshadow>
    # Not part of g++'s -Wconversion; indices into Eigen and the standard library mix signs everywhere.
    $<$<CXX_COMPILER_ID:Clang,AppleClang>:-Wno-sign-conversion>
    # g++ 12 warns about operator+ of std::string (GCC bug 105651).
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
endfunction()

# calligraphy_call_foreign_code(target): for targets that call functions of a library loaded at run time, whose types
# clang's function sanitizer cannot verify.
function(calligraphy_call_foreign_code target)
  if(CALLIGRAPHY_SANITIZE MATCHES "undefined" AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_compile_options(${target} PRIVATE -fno-sanitize=function)
  endif()
endfunction()

# calligraphy_embed(variable folder name file ...): generates a source file that defines each text file as
# calligraphy::built_in::name, declared in src/folder/built_in.hpp.
function(calligraphy_embed variable folder)
  string(REPLACE "/" "_" name ${folder})
  set(source ${PROJECT_BINARY_DIR}/built_in_${name}.cpp)
  set(content "#include <${PROJECT_SOURCE_DIR}/src/${folder}/built_in.hpp>\n\nnamespace calligraphy::built_in {\n")
  set(pairs ${ARGN})
  while(pairs)
    list(POP_FRONT pairs name file)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} text)
    string(APPEND content "\nconst char* const ${name} = R\"calligraphy(${text})calligraphy\";\n")
  endwhile()
  string(APPEND content "\n}  // namespace calligraphy::built_in\n")
  file(CONFIGURE OUTPUT ${source} CONTENT "@content@" @ONLY)
  set(${variable} ${source} PARENT_SCOPE)
endfunction()
