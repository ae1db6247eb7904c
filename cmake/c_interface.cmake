# calligraphy_c_functions(variable): the names of the functions that the header of the C interface declares.
function(calligraphy_c_functions variable)
  set(header ${PROJECT_SOURCE_DIR}/include/calligraphy/c/calligraphy.h)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
  file(STRINGS ${header} functions REGEX "^CALLIGRAPHY_API .*calligraphy_[a-z0-9_]+\\(")
  list(TRANSFORM functions REPLACE ".*(calligraphy_[a-z0-9_]+)\\(.*" "\\1")
  set(${variable} ${functions} PARENT_SCOPE)
endfunction()

# calligraphy_export_c(target): of this shared library, only the functions of the C interface are visible. Programs keep
# working with it until its SONAME changes, with every minor version.
function(calligraphy_export_c target)
  set_target_properties(${target} PROPERTIES
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_definitions(${target} PRIVATE CALLIGRAPHY_C_BUILD)
  if(CMAKE_SYSTEM_NAME STREQUAL "Linux")  # hides what the components and libstdc++'s templates would export
    calligraphy_c_functions(functions)
    list(JOIN functions "; " functions)
    set(script ${PROJECT_BINARY_DIR}/c_exports.map)
    file(CONFIGURE OUTPUT ${script} CONTENT "{ global: @functions@; local: *; };\n" @ONLY)
    target_link_options(${target} PRIVATE "LINKER:--version-script=${script}")
    set_target_properties(${target} PROPERTIES LINK_DEPENDS ${script})
  endif()
endfunction()
