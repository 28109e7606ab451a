find_package(nlohmann_json REQUIRED)
farcell_tests(tools/extract/textures DEPS farcell_tests_support farcell_tools_extract_textures farcell_tools_image
                                          nlohmann_json::nlohmann_json)
add_dependencies(tools_extract_textures_test farcell-extract)
