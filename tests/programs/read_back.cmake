# What the programs write, in the hands of others: ncdump, netCDF4, h5netcdf, xarray; and the Python of the documents.
if(CARDAN_PEER_PYTHON)
    # add_read_back(<name> <fixture of the run> <arguments of read_back.py>...)
    function(add_read_back name fixture)
        add_test(NAME ${name} COMMAND ${CARDAN_PEER_PYTHON} ${PROJECT_SOURCE_DIR}/tests/peers/read_back.py ${ARGN}
                 WORKING_DIRECTORY ${test_output_dir})
        set_tests_properties(${name} PROPERTIES FIXTURES_REQUIRED "${fixture}" SKIP_RETURN_CODE 77)
    endfunction()

    set(coarse --blade-elements 1 --tower-elements 1)
    add_example_test(read_back_write_campbell wt600_campbell 0 "files: read_back_campbell.h5" --rpm 0:30:10 ${coarse}
                     --out read_back_campbell)
    add_example_test(read_back_write_floquet teetered_floquet 0 "read_back_floquet.h5" --gravity --max 20 ${coarse} --no-pictures
                     --no-teeter --harmonics 4 --out read_back_floquet)
    add_example_test(read_back_write_model cardan 0 "read_back_model.h5" linearise wt600 --rpm 27 ${coarse} --azimuths 7
                     --out read_back_model)
    add_example_test(read_back_write_run wt600_time_history 0 "read_back_run.h5" ${coarse} --duration 5 --out read_back_run)
    add_example_test(read_back_write_table cardan 0 "rows of" convert read_back_run.h5 read_back_run.csv)
    set_tests_properties(read_back_write_campbell PROPERTIES FIXTURES_SETUP read_back_campbell)
    set_tests_properties(read_back_write_floquet PROPERTIES FIXTURES_SETUP read_back_floquet)
    set_tests_properties(read_back_write_model PROPERTIES FIXTURES_SETUP read_back_model)
    set_tests_properties(read_back_write_run PROPERTIES FIXTURES_SETUP read_back_run)
    set_tests_properties(read_back_write_table PROPERTIES FIXTURES_SETUP read_back_table FIXTURES_REQUIRED read_back_run)

    add_read_back(read_back_campbell read_back_campbell read_back_campbell.h5 --campbell read_back_campbell.csv)
    add_read_back(read_back_floquet read_back_floquet read_back_floquet.h5 --campbell read_back_floquet.csv)
    add_read_back(read_back_model read_back_model read_back_model.h5)
    add_read_back(read_back_run "read_back_run;read_back_table" read_back_run.h5 --history read_back_run.csv)
    set_tests_properties(read_back_run PROPERTIES LABELS slow) # half a minute

    foreach(document IN ITEMS file_formats linear_models)
        add_test(NAME python_snippets_${document}
                 COMMAND ${CARDAN_PEER_PYTHON} ${PROJECT_SOURCE_DIR}/tests/peers/python_snippets.py
                         ${PROJECT_SOURCE_DIR}/docs/${document}.md python_snippets_${document} wt600_campbell.h5=read_back_campbell.h5
                         wt600_linear.h5=read_back_model.h5 run.h5=read_back_run.h5
                 WORKING_DIRECTORY ${test_output_dir})
        set_tests_properties(python_snippets_${document} PROPERTIES SKIP_RETURN_CODE 77
                             FIXTURES_REQUIRED "read_back_campbell;read_back_model;read_back_run")
    endforeach()
endif()
