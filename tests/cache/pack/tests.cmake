# zlib is the decoder that shares nothing with ours.
find_package(ZLIB REQUIRED)
farcell_tests(cache/pack DEPS farcell_cache_pack ZLIB::ZLIB APART geometry_page_test.cpp)
