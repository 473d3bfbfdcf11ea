add_example_test(example_jeffcott_rotor jeffcott_rotor 0 "at 900 rad/s: forward, 1/s +0[.]691889[0-9]+ +0[.]6918893.*limit of stability, rad/s +790[.]56942 +790[.]56942")
add_example_test(example_jeffcott_rotor_outer jeffcott_rotor 0 "limit of stability, rad/s +1264[.]911[01][0-9] +1264[.]91106" --internal-damping=20 --out=jeffcott_rotor_outer.png)
