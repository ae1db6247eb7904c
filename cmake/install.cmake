# What find_package(calligraphy) needs of an installed copy.
include(CMakePackageConfigHelpers)

install(FILES include/calligraphy/calligraphy.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/calligraphy)
install(EXPORT calligraphyTargets NAMESPACE calligraphy:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/calligraphy)
if(CALLIGRAPHY_WITH_PHANTOM)
  install(EXPORT calligraphyPhantomTargets NAMESPACE calligraphy::
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/calligraphy)
endif()
# What each component depends on and needs, as calligraphyConfig.cmake reads it.
get_property(components GLOBAL PROPERTY CALLIGRAPHY_COMPONENTS)
set(calligraphy_component_table "set(calligraphy_components ${components})\n")
foreach(component ${components})
  foreach(kind DEPENDS NEEDS)
    get_property(list GLOBAL PROPERTY CALLIGRAPHY_${component}_${kind})
    string(APPEND calligraphy_component_table "set(calligraphy_${component}_${kind} ${list})\n")
  endforeach()
endforeach()
configure_package_config_file(cmake/calligraphyConfig.cmake.in ${PROJECT_BINARY_DIR}/calligraphyConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/calligraphy)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/calligraphyConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/calligraphyConfig.cmake ${PROJECT_BINARY_DIR}/calligraphyConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/calligraphy)
