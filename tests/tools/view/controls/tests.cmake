farcell_tests(tools/view/controls DEPS farcell_tools_view_controls)
