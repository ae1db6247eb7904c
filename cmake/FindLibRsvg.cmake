# librsvg, which has no package of its own for CMake: the target PkgConfig::LIBRSVG.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(LIBRSVG QUIET IMPORTED_TARGET librsvg-2.0>=2.52 cairo-pdf>=1.16)
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LibRsvg REQUIRED_VARS LIBRSVG_LINK_LIBRARIES VERSION_VAR LIBRSVG_VERSION)
