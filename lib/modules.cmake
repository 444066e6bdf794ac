# The modules of the library. A module is a folder of lib/lyrefit, a target lyrefit_NAME and the tests of tests/FOLDER. It
# may include, and links, the modules after LINK and those that these link. The build (CMakeLists.txt beside this file) and
# the test of include directions (cmake/CheckLayers.cmake) read this table; cmake/sizes.txt bounds its sizes.
#   lyrefit_module(NAME [FOLDER folder] [LINK module...] [WITH library...] [ARITHMETIC|TEXT])
# WITH: libraries by others. ARITHMETIC: all of the module is optimized fully; of the others only the sources that say so in
# their first line (`// Optimized fully: ...`). TEXT: it makes texts and is compiled fast.

# The core: a curve goes in, parameters of a diode model with their uncertainties come out.
lyrefit_module(base WITH Boost::boost Eigen3::Eigen fmt::fmt glog::glog Threads::Threads)
lyrefit_module(curve LINK base WITH Eigen3::Eigen fmt::fmt glog::glog)
lyrefit_module(model LINK curve WITH Boost::boost Eigen3::Eigen fmt::fmt glog::glog ARITHMETIC)
lyrefit_module(search LINK base WITH glog::glog ARITHMETIC)
lyrefit_module(refine FOLDER estimate/refine LINK model WITH Ceres::ceres Eigen3::Eigen fmt::fmt glog::glog ARITHMETIC)
lyrefit_module(fit FOLDER estimate/fit LINK refine search WITH Eigen3::Eigen fmt::fmt glog::glog)

# Files to curves; settings of a fit from files.
lyrefit_module(read LINK model WITH fmt::fmt glog::glog LibCsv::csv nlohmann_json::nlohmann_json)
lyrefit_module(stream LINK read WITH fmt::fmt LibCsv::csv nlohmann_json::nlohmann_json ZLIB::ZLIB)
lyrefit_module(settings LINK fit read WITH fmt::fmt nlohmann_json::nlohmann_json TEXT)

# Documents, figures and pages, and those of a fit.
lyrefit_module(report LINK fit read WITH Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json ZLIB::ZLIB TEXT)

# What else is estimated, proved and found.
lyrefit_module(effects LINK fit WITH Boost::boost Eigen3::Eigen fmt::fmt glog::glog ARITHMETIC)
lyrefit_module(cite LINK effects report WITH fmt::fmt nlohmann_json::nlohmann_json TEXT)
lyrefit_module(simulate LINK effects settings WITH fmt::fmt nlohmann_json::nlohmann_json)
lyrefit_module(certify LINK report WITH Boost::boost Eigen3::Eigen fmt::fmt glog::glog nlohmann_json::nlohmann_json)
lyrefit_module(family LINK report WITH Boost::boost Eigen3::Eigen fmt::fmt glog::glog nlohmann_json::nlohmann_json)
lyrefit_module(devices LINK family WITH Boost::boost Eigen3::Eigen fmt::fmt glog::glog nlohmann_json::nlohmann_json)
lyrefit_module(diagnose LINK effects report WITH Boost::boost Eigen3::Eigen fmt::fmt glog::glog nlohmann_json::nlohmann_json)
lyrefit_module(translate LINK diagnose WITH Boost::boost Eigen3::Eigen fmt::fmt glog::glog nlohmann_json::nlohmann_json)
lyrefit_module(trend LINK report stream WITH Boost::boost Eigen3::Eigen fmt::fmt glog::glog nlohmann_json::nlohmann_json)
lyrefit_module(inspect LINK report stream WITH fmt::fmt nlohmann_json::nlohmann_json TEXT)

# On top: many curves, comparisons of searches and audits.
lyrefit_module(batch LINK certify devices stream translate trend
               WITH Boost::boost Eigen3::Eigen fmt::fmt glog::glog LibCsv::csv nlohmann_json::nlohmann_json ZLIB::ZLIB)
lyrefit_module(study LINK certify devices diagnose settings
               WITH Boost::boost Eigen3::Eigen fmt::fmt glog::glog nlohmann_json::nlohmann_json)
