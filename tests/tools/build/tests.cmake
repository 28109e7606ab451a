farcell_tests(tools/build DEPS farcell_preprocess_read nlohmann_json::nlohmann_json)
if(TARGET tools_build_test)
  add_dependencies(tools_build_test farcell-build farcell-info)
endif()
