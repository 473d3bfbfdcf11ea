add_example_test(example_flexible_slider_crank flexible_slider_crank 0 "0[.]0300 +0[.]2301015[0-9]+ +0[.]230101578 +-0[.]6158[0-9]+ +-0[.]61604")
