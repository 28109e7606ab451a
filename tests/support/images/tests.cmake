pkg_check_modules(oiio REQUIRED IMPORTED_TARGET OpenImageIO)
farcell_library(tests/support/images DEPS farcell_cache_base PRIVATE PkgConfig::oiio)
