# The rooms of the house and what each may include: itself, what stands here, and what those may include. Each is a library
# that links those (cmake/cardanLibrary.cmake); the test `layering` holds all #include lines, and the drawing in
# CONTRIBUTING.md, against this table.
#
# room(<folder> [SEES <rooms>] [USES <libraries>])

room(mbs/base USES decompositions) # errors, files, units, numbers and small vectors
room(mbs/model SEES mbs/base) # the tree: bodies, joints, coordinates
room(mbs/kernels SEES mbs/model USES inverses) # kinematics, metric, Christoffel symbols, recursions
room(mbs/loops SEES mbs/kernels) # closed loops: cut joints, projection in the metric, assembly
room(mbs/system SEES mbs/loops) # a model, its forces and loops, what its joints carry, channels
room(mbs/geometry SEES mbs/kernels) # curvature, embedding, change of chart
room(mbs/batch SEES mbs/kernels USES tbb) # many states at once
room(mbs/urdf SEES mbs/system USES urdfdom) # robots as files

room(elements/sections SEES mbs/model) # cross sections, reference lines
room(elements/machine_elements SEES mbs/system) # joints, drives, brakes, generators, stops, loads
room(elements/controllers SEES mbs/system USES dl) # signals, filters, actuators, controllers
room(elements/wind SEES mbs/base) # wind over place and time: shear, tables, gusts, turbulent boxes
room(elements/turbulence SEES elements/wind USES boost fft) # spectra and tensors of turbulence, boxes made from them
room(elements/aerodynamics SEES mbs/model elements/wind USES boost) # polars, blade-element momentum
room(elements/electric SEES elements/machine_elements elements/controllers) # circuits, electric machines, the grid
room(elements/cardan_beam SEES elements/sections elements/machine_elements) # the cardanic joint beam element

room(solvers/algebra SEES mbs/base USES sundials fft) # eigenvalues, Schur forms, Fourier, collocation
room(solvers/linear SEES solvers/algebra mbs/system) # operating point, linearisation, modes, Coleman transformation
room(solvers/equilibrium SEES solvers/linear USES sundials) # steady states, load paths, buckling
room(solvers/periodic SEES solvers/equilibrium) # harmonic balance, shooting, Floquet, forced response
room(solvers/campbell_data SEES solvers/periodic) # Campbell diagrams as data: modes, branches; tables, CSV, differences
room(solvers/mode_names SEES solvers/campbell_data) # energy shares, tracking, names of branches
room(solvers/campbell SEES solvers/mode_names) # Campbell diagrams: modes at a point by each method, sweeps
room(solvers/stability SEES solvers/campbell USES boost) # where flutter and divergence begin over a parameter
room(solvers/linear_models SEES solvers/periodic) # linear models for the design of controllers
room(solvers/signals SEES solvers/algebra mbs/system) # histories, sampling, spectra, envelopes, cycles
room(solvers/time SEES solvers/signals USES sundials) # time integration
room(solvers/atlas SEES solvers/time mbs/geometry) # time integration in several charts
room(solvers/hdf5 SEES solvers/campbell_data solvers/time USES hdf5) # diagrams and histories as files
room(solvers/hdf5_models SEES solvers/hdf5 solvers/linear_models) # linear models as HDF5 files
room(solvers/matlab SEES solvers/linear_models USES matio) # linear models as MATLAB files
room(solvers/pictures SEES solvers/campbell_data solvers/signals) # through gnuplot

room(turbines/model SEES elements/cardan_beam) # description of a turbine, its mesh, assembly to a system, channels
room(turbines/tables SEES mbs/base) # CSV; the tables of the machines, within the library
room(turbines/readers SEES turbines/model turbines/tables elements/aerodynamics elements/controllers) # OpenFAST's files
room(turbines/yaml SEES turbines/readers USES libyaml) # our own files, windIO's
room(turbines/aerodynamics SEES turbines/model turbines/tables elements/aerodynamics) # air on the blades and the tower of a machine
room(turbines/reference_turbines SEES turbines/model turbines/tables elements/controllers) # 600 kW, teetered, NREL 5 MW
room(turbines/electric SEES turbines/reference_turbines elements/electric) # machines with their generators as circuits
room(turbines/actuators SEES turbines/model elements/controllers) # pitch drives and generator torque as actuators
room(turbines/operation SEES turbines/aerodynamics solvers/campbell USES boost) # operating points over the wind, and their modes
room(turbines/machine SEES turbines/yaml turbines/reference_turbines turbines/operation solvers/hdf5) # a machine with all that belongs to it, from whatever source
room(turbines/analysis SEES turbines/machine turbines/actuators solvers/linear_models) # simulation, Campbell diagram, linear model of a machine

room(programs/shared SEES turbines/analysis turbines/electric elements/turbulence solvers/stability solvers/hdf5_models solvers/matlab solvers/pictures mbs/batch mbs/urdf USES cli11) # what programs and studies have in common
room(programs/cardan SEES programs/shared) # the commands of `cardan`
room(programs SEES programs/cardan)
room(examples SEES turbines/analysis turbines/electric elements/turbulence solvers/stability solvers/hdf5_models solvers/matlab solvers/pictures mbs/batch mbs/urdf solvers/atlas) # short scripts
room(examples/studies SEES examples programs/shared) # of papers and methods

# Headers of libraries that only some rooms may include: library(<name> <what they begin with>...)
library(sundials sundials/ cvode/ cvodes/ ida/ idas/ arkode/ kinsol/ nvector/ sunmatrix/ sunlinsol/ sunnonlinsol/)
library(hdf5 hdf5 H5)
library(matio matio)
library(libyaml yaml.h)
library(boost boost/)
library(dl dlfcn.h)
library(tbb tbb/ oneapi/)
library(urdfdom urdf tinyxml console_bridge)
library(fft unsupported/)
library(cli11 CLI/)
# All others: mbs/base/decompositions.hpp.
library(decompositions Eigen/Cholesky Eigen/Dense Eigen/Eigenvalues Eigen/LU Eigen/QR Eigen/SVD)
library(inverses Eigen/LU) # of small matrices
