farcell_tests(tools/image DEPS farcell_tools_image)
