# What find_package(calligraphy) needs of an installed copy.
include(CMakePackageConfigHelpers)

install(FILES include/calligraphy/calligraphy.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/calligraphy)
install(EXPORT calligraphyTargets NAMESPACE calligraphy:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/calligraphy)
if(CALLIGRAPHY_WITH_PHANTOM)
  install(EXPORT calligraphyPhantomTargets NAMESPACE calligraphy::
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/calligraphy)
endif()
configure_package_config_file(cmake/calligraphyConfig.cmake.in ${PROJECT_BINARY_DIR}/calligraphyConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/calligraphy)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/calligraphyConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/calligraphyConfig.cmake ${PROJECT_BINARY_DIR}/calligraphyConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/calligraphy)
