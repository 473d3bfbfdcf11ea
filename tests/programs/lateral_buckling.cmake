add_example_test(example_lateral_buckling lateral_buckling 0 "EI_y infinite +4[.]01[0-9]+ +4[.]012599.*EI_y = 10 EI_z +4[.]62[0-9]+ +4[.]624632.*EI_y = 100 EI_z +4[.]05[0-9]+ +4[.]059627")
