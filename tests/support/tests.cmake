find_package(nlohmann_json REQUIRED)
farcell_library(tests/support DEPS farcell_cache_pack farcell_shaders_shared nlohmann_json::nlohmann_json)
# The brute-force baker would take minutes in a debug build with sanitizers.
target_compile_options(farcell_tests_support PRIVATE -O2)
