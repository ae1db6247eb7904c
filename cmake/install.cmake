# Installs what find_package(calligraphy) needs.
include(CMakePackageConfigHelpers)

install(FILES include/calligraphy/calligraphy.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/calligraphy)
install(EXPORT calligraphyTargets NAMESPACE calligraphy:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/calligraphy)
if(CALLIGRAPHY_WITH_PHANTOM)
  install(EXPORT calligraphyPhantomTargets NAMESPACE calligraphy::
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/calligraphy)
endif()
# Dependencies and packages of each component, for calligraphyConfig.cmake.
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
              cmake/FindLibRsvg.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/calligraphy)
if(CALLIGRAPHY_C)
  file(RELATIVE_PATH prefix_from_pkgconfig /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)  # so that the prefix may be moved
  configure_file(cmake/calligraphy_c.pc.in ${PROJECT_BINARY_DIR}/calligraphy_c.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/calligraphy_c.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endif()
