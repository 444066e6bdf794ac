# What `cmake --install` lays down: the public headers, the library, the command (by its own folder) and
# the package that find_package(lyrefit) finds.
include(CMakePackageConfigHelpers)
set(LYREFIT_PACKAGE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/lyrefit")

# Public is what stands in this list. Whatever a header here includes must stand here too: the test
# `package` compiles each one alone from the installed tree, where the others are not.
set(LYREFIT_PUBLIC_HEADERS
  lyrefit.h
  base/constants.h
  base/dual.h
  base/enum_text.h
  base/error.h
  base/file.h
  base/numbers.h
  base/observer.h
  base/option.h
  base/parallel.h
  base/portable_exp.h
  base/random.h
  base/version.h
  certify/certify.h
  curve/check_readings.h
  curve/curve_files.h
  curve/curve_set.h
  curve/iv_curve.h
  curve/key_points.h
  curve/nearest_curve.h
  curve/read_curve.h
  curve/write_curve.h
  law/current.h
  law/curve_shape.h
  law/device.h
  law/effect.h
  law/extension.h
  law/kernel.h
  law/law.h
  law/model_points.h
  law/pack.h
  law/pack.inc
  law/parameter.h
  law/reading.h
  law/solve.h
  law/string_layout.h
  law/term.h
  law/translation.h
  diagnose/diagnose.h
  diagnose/diagnosis.h
  diagnose/healthy.h
  diagnose/plan.h
  effects/catalogue.h
  family/coefficients.h
  family/data_sheet.h
  family/family_report.h
  family/fit_family.h
  family/fit_free.h
  family/pvlib_parameters.h
  family/read_pvlib.h
  fit/bounds.h
  fit/error_spec.h
  fit/fit.h
  fit/fit_report.h
  fit/simulate.h
  fit/statistics.h
  refine/error_terms.h
  report/audit_csv.h
  report/audit_json.h
  report/audit_text.h
  report/certificate_plot.h
  report/certificate_text.h
  report/compare_csv.h
  report/compare_json.h
  report/compare_plot.h
  report/compare_text.h
  report/coverage_text.h
  report/data_sheet_text.h
  report/diagnosis_plot.h
  report/diagnosis_text.h
  report/family_csv.h
  report/family_plot.h
  report/family_text.h
  report/fits_table.h
  report/healthy_text.h
  report/json.h
  report/plot.h
  report/text_report.h
  report/truth_text.h
  search/search.h
  study/audit.h
  study/compare.h
  study/coverage.h
  study/landscape.h
  study/pool.h
  study/pool_ranks.h
  study/rank_tests.h
  study/read_audit_rows.h
  study/truth.h
  study/verdict.h)
list(TRANSFORM LYREFIT_PUBLIC_HEADERS PREPEND "${PROJECT_SOURCE_DIR}/lib/lyrefit/")
target_sources(lyrefit PUBLIC FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}/lib"
                              FILES ${LYREFIT_PUBLIC_HEADERS})
# Before 1.0 a new minor version may change the interface.
set_target_properties(lyrefit PROPERTIES VERSION ${PROJECT_VERSION}
                      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

install(TARGETS lyrefit EXPORT lyrefit-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
# What the records look like that are written as JSON.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/data/schema" DESTINATION ${CMAKE_INSTALL_DATADIR}/lyrefit
        FILES_MATCHING PATTERN "*.json")
install(EXPORT lyrefit-targets NAMESPACE lyrefit:: DESTINATION ${LYREFIT_PACKAGE_DIR})

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/lyrefit-config.cmake.in"
                              "${PROJECT_BINARY_DIR}/lyrefit-config.cmake"
                              INSTALL_DESTINATION ${LYREFIT_PACKAGE_DIR})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/lyrefit-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/lyrefit-config.cmake"
              "${PROJECT_BINARY_DIR}/lyrefit-config-version.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/FindLibCsv.cmake"
        DESTINATION ${LYREFIT_PACKAGE_DIR})
