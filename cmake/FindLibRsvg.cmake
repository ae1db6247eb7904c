# librsvg, which has no package of its own for CMake: the target PkgConfig::LIBRSVG, with cairo.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(LIBRSVG QUIET IMPORTED_TARGET librsvg-2.0>=2.52)
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LibRsvg REQUIRED_VARS LIBRSVG_VERSION)
