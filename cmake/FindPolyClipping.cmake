# Clipper 6 (Debian: libpolyclipping-dev), which ships only a pkg-config file.
find_path(PolyClipping_INCLUDE_DIR polyclipping/clipper.hpp)
find_library(PolyClipping_LIBRARY NAMES polyclipping)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PolyClipping REQUIRED_VARS PolyClipping_LIBRARY PolyClipping_INCLUDE_DIR)
if(PolyClipping_FOUND AND NOT TARGET PolyClipping::PolyClipping)
  add_library(PolyClipping::PolyClipping UNKNOWN IMPORTED)
  set_target_properties(PolyClipping::PolyClipping PROPERTIES
    IMPORTED_LOCATION "${PolyClipping_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${PolyClipping_INCLUDE_DIR}")
endif()
