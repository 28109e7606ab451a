farcell_tests(tools/view DEPS farcell_tests_support farcell_runtime_camera farcell_tools_image
                              nlohmann_json::nlohmann_json)
add_dependencies(tools_view_test farcell-view farcell-render)
