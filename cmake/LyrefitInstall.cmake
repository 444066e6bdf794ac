# Installation by `cmake --install`: the public headers, the library, the command (by its own folder) and the package
# for find_package(lyrefit).
include(CMakePackageConfigHelpers)
set(LYREFIT_PACKAGE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/lyrefit")

# Headers in these lists are public; all others are internal and may change at any time. A header that a public header
# includes must be listed too. Those in data/stable/promised.txt stay as they are within a major version; the first line
# of the others says that they are experimental. The test `package` compiles each one alone from the installed tree,
# which lacks the internal headers.
set(LYREFIT_PUBLIC_HEADERS
  # public headers
  lyrefit.h
  certify/certify.h
  diagnose/diagnose.h
  diagnose/reference.h
  model/effects/catalogue.h
  estimate/cell/compare_directions.h
  estimate/cell/fill_factor_losses.h
  estimate/cell/ideality_over_light.h
  estimate/cell/series_resistance.h
  estimate/cell/superposition.h
  estimate/cell/joint_estimate.h
  estimate/cell/describe_cell.h
  estimate/family/coefficients.h
  estimate/family/data_sheet.h
  estimate/family/data_sheet_family.h
  estimate/family/fit_family.h
  estimate/family/fit_individually.h
  estimate/family/fit_two_junctions.h
  estimate/family/pvlib_parameters.h
  estimate/fit/fit.h
  certify/floor.h
  estimate/fit/fit_files.h
  estimate/fit/simulate.h
  model/kernel.h
  search/search.h
  trend/read_trend.h
  trend/trend.h
  trend/trend_series.h
  translate/procedures.h
  translate/translate.h
  translate/uncertainty.h
  # options of these functions
  certify/certify_options.h
  diagnose/diagnose_options.h
  diagnose/priors.h
  diagnose/reference_options.h
  estimate/cell/cell_options.h
  estimate/family/family_options.h
  estimate/family/two_junction_options.h
  estimate/fit/bounds.h
  estimate/fit/error_spec.h
  estimate/fit/fit_options.h
  search/search_options.h
  translate/checklist_options.h
  translate/device_coefficients.h
  translate/field_notes.h
  translate/field_test_options.h
  translate/translate_options.h
  translate/uncertainty_options.h
  trend/trend_options.h
  # records that these functions return
  read/curve_set.h
  read/iv_curve.h
  diagnose/diagnosis.h
  diagnose/reference_comparison.h
  diagnose/plan.h
  estimate/cell/cell_report.h
  estimate/family/family_report.h
  estimate/family/two_junction_report.h
  estimate/fit/fit_report.h
  estimate/refine/error_terms.h
  estimate/refine/estimate.h
  search/search_summary.h
  translate/checklist.h
  translate/field_test.h
  translate/translation_report.h
  trend/trend_report.h
  # readers, and the writer of curves
  read/assumption.h
  read/bare_curve.h
  read/batch_source.h
  read/check_readings.h
  read/condition_options.h
  read/curve_files.h
  read/date_time.h
  read/nearest_curve.h
  read/number_text.h
  read/read_curve.h
  read/spreadsheet_text.h
  read/write_curve.h
  estimate/family/module_sheet.h
  estimate/family/read_module.h
  estimate/family/read_pvlib.h
  estimate/family/simulate_module.h
  estimate/family/write_pan.h
  # writers of the records
  report/csv.h
  report/document.h
  report/documents.h
  report/figure.h
  report/json.h
  report/page.h
  report/plots.h
  report/readable.h
  report/text_layout.h
  # laws, and the headers for a user's own effect
  model/curve_shape.h
  model/device.h
  model/effect.h
  model/device_effects.h
  model/law.h
  model/pack.h
  model/pack.inc
  model/parameter.h
  model/two_junctions.h
  model/plain_stage.h
  model/reading.h
  model/single_diodes.h
  model/solve.h
  model/string_layout.h
  model/term.h
  model/translation.h
  read/key_points.h
  # headers that all others share
  base/constants.h
  base/dual.h
  base/enum_text.h
  base/error.h
  base/file.h
  base/former_names.h
  base/numbers.h
  base/observer.h
  base/option.h
  read/setting_text.h
  estimate/fit/effect_text.h
  base/parallel.h
  base/portable_exp.h
  base/public.h
  base/random.h
  base/seconds.h
  base/stoppable_reads.h
  base/version.h)
set(LYREFIT_STUDY_PUBLIC_HEADERS
  study.h
  study/audit.h
  study/audit_options.h
  study/audit_report.h
  study/compare.h
  study/compare_options.h
  study/comparison.h
  study/algorithms.h
  study/rank_tests.h
  study/read_audit_rows.h
  study/report/audit_csv.h
  study/report/audit_json.h
  study/report/compare_csv.h
  study/report/compare_json.h
  study/report/compare_plot.h
  study/report/documents.h)
set(LYREFIT_BATCH_PUBLIC_HEADERS
  batch.h
  batch/batch.h
  batch/batch_options.h
  batch/batch_task.h
  batch/campaign_summary.h
  batch/pack.h
  batch/history.h
  batch/plan_task.h
  batch/pixel_options.h
  batch/plant_page.h
  batch/result_row.h
  batch/sample_summary.h
  batch/sparkline.h
  batch/string_plan.h
  batch/string_pages.h)
foreach(header IN LISTS LYREFIT_PUBLIC_HEADERS LYREFIT_STUDY_PUBLIC_HEADERS LYREFIT_BATCH_PUBLIC_HEADERS)
  get_filename_component(folder "lyrefit/${header}" DIRECTORY)
  install(FILES "${PROJECT_SOURCE_DIR}/lib/lyrefit/${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/${folder}"
          COMPONENT dev)
endforeach()

# Components of packages: `runtime` is the shared library, `dev` the files for compiling, `command` the program on the
# shared library (LyrefitPackages.cmake). `cmake --install` without a component installs the library type that
# BUILD_SHARED_LIBS selects. The other type is built and installed if its component is requested.
foreach(kind static shared)
  if(NOT TARGET lyrefit_${kind})
    continue()
  endif()
  set(by_default)
  if((kind STREQUAL "shared" AND NOT BUILD_SHARED_LIBS) OR (kind STREQUAL "static" AND BUILD_SHARED_LIBS))
    set(by_default EXCLUDE_FROM_ALL)
    set_target_properties(lyrefit_${kind} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
  install(TARGETS lyrefit_${kind} EXPORT lyrefit-${kind}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev ${by_default}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT dev ${by_default})
  install(EXPORT lyrefit-${kind} NAMESPACE lyrefit:: FILE lyrefit-${kind}-targets.cmake
          DESTINATION ${LYREFIT_PACKAGE_DIR} COMPONENT dev ${by_default})
endforeach()

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/lyrefit-config.cmake.in"
                              "${PROJECT_BINARY_DIR}/lyrefit-config.cmake"
                              INSTALL_DESTINATION ${LYREFIT_PACKAGE_DIR})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/lyrefit-config-version.cmake"
                                 COMPATIBILITY SameMajorVersion)
install(FILES "${PROJECT_BINARY_DIR}/lyrefit-config.cmake"
              "${PROJECT_BINARY_DIR}/lyrefit-config-version.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/FindLibCsv.cmake"
        DESTINATION ${LYREFIT_PACKAGE_DIR} COMPONENT dev)
# Requires.private is omitted, because pkg-config would then require the dependencies' files even for the shared
# library. The file of pkg-config states its prefix relative to itself, so that an installed tree may be moved.
file(RELATIVE_PATH LYREFIT_PREFIX_FROM_PC "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
configure_file("${PROJECT_SOURCE_DIR}/cmake/lyrefit.pc.in" "${PROJECT_BINARY_DIR}/lyrefit.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/lyrefit.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT dev)
# Schemas of the JSON records.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/data/schema" DESTINATION ${CMAKE_INSTALL_DATADIR}/lyrefit COMPONENT dev
        FILES_MATCHING PATTERN "*.json")
