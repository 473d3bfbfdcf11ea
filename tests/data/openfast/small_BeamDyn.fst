------- OpenFAST INPUT FILE -------------------------------------------
Fictitious 100 kW machine
---------------------- SIMULATION CONTROL --------------------------------------
         False   Echo         - (flag)
       "FATAL"   AbortLevel   - (-)
            10   TMax         - (s)
          0.01   DT           - (s)
---------------------- FEATURE SWITCHES AND FLAGS ------------------------------
             2   CompElast    - 1: ElastoDyn; 2: with BeamDyn
             0   CompInflow   - (switch)
             0   CompAero     - (switch)
             1   CompServo    - (switch)
             0   CompHydro    - (switch)
             0   CompSub      - (switch)
             0   CompMooring  - (switch)
             0   CompIce      - (switch)
---------------------- ENVIRONMENT ---------------------------------------------
       9.80665   Gravity      - (m/s^2)
---------------------- INPUT FILES ---------------------------------------------
"small_ElastoDyn.dat"    EDFile       - structure
"small_BeamDyn.dat"    BDBldFile(1) - blade 1
"small_BeamDyn.dat"    BDBldFile(2) - blade 2
"small_BeamDyn.dat"    BDBldFile(3) - blade 3
"unused"    AeroFile     - aerodynamics
".\small_ServoDyn.dat"    ServoFile    - control
---------------------- OUTPUT --------------------------------------------------
          True   SumPrint     - (flag)
             0   TStart       - (s)
