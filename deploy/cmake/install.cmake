# What `cmake --install` puts where: programs, the contract, and the libraries of two components with their headers.
#   planning  plans within the process: kcs::planning with kcs::gcode, which reads programs, and kcs::motion
#   client    calls the service: kcs::client
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# A header is included as "server/planning/plan.h" here and as <kcs/planning/plan.h> by users. Listed are the public
# ones, with all that they include.
set(public_includes ${PROJECT_BINARY_DIR}/public)
set(public_headers)
function(kcs_public_headers part folder)
  foreach(header IN LISTS ARGN)
    set(source ${PROJECT_SOURCE_DIR}/${folder}/${header})
    set(public ${public_includes}/kcs/${part}/${header})
    add_custom_command(OUTPUT ${public} DEPENDS ${source} VERBATIM
                       COMMAND sed -e "s|\"client/sdk/\\(.*\\)\"|<kcs/client/\\1>|" -e "s|\"server/\\(.*\\)\"|<kcs/\\1>|"
                               ${source} > ${public})
    list(APPEND public_headers ${public})
  endforeach()
  file(MAKE_DIRECTORY ${public_includes}/kcs/${part})
  set(public_headers ${public_headers} PARENT_SCOPE)
endfunction()
kcs_public_headers(client client/sdk connection.h error.h live_stream.h machine.h machine_profile.h machines.h plan.h
                   plan_list.h planner.h run.h setpoint_stream.h settings_error.h)
kcs_public_headers(motion server/motion limits.h path.h phase.h phase_code.h place_sampler.h program_lines.h progress.h line.h
                   sampler.h setpoint.h straight_run.h trajectory.h)
kcs_public_headers(planning server/planning corner.h corner_list.h invalid_input.h marker.h options.h plan.h plan_path.h
                   range.h stopped.h toolpath.h)
kcs_public_headers(gcode server/gcode notices.h options.h read_program.h)
add_custom_target(kcs_public_headers ALL DEPENDS ${public_headers})
install(DIRECTORY ${public_includes}/kcs DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)

install(TARGETS kcsd kcsctl kcs-gateway COMPONENT programs)
install(DIRECTORY proto/kcs/v1 DESTINATION ${CMAKE_INSTALL_DATADIR}/kcs/proto/kcs COMPONENT development
        FILES_MATCHING PATTERN "*.proto")
install(DIRECTORY proto/google DESTINATION ${CMAKE_INSTALL_DATADIR}/kcs/proto COMPONENT development
        FILES_MATCHING PATTERN "*.proto")

foreach(library client proto planning gcode motion)
  set_target_properties(kcs_${library} PROPERTIES EXPORT_NAME ${library})  # users link kcs::client
  target_compile_features(kcs_${library} PUBLIC cxx_std_20)
endforeach()
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/kcs)
# Both ways to find kcs go by where they lie themselves: the prefix is chosen when installing.
file(RELATIVE_PATH prefix_of_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
foreach(component client planning)
  set(libraries_client kcs_client kcs_proto)
  set(libraries_planning kcs_planning kcs_motion kcs_gcode)
  install(TARGETS ${libraries_${component}} EXPORT kcs-${component} COMPONENT development
          INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT kcs-${component} NAMESPACE kcs:: DESTINATION ${package} COMPONENT development)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/kcs-${component}.pc.in kcs-${component}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/kcs-${component}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
          COMPONENT development)
endforeach()
configure_file(${CMAKE_CURRENT_LIST_DIR}/kcsConfig.cmake kcsConfig.cmake COPYONLY)
write_basic_package_version_file(kcsConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/kcsConfig.cmake ${PROJECT_BINARY_DIR}/kcsConfigVersion.cmake DESTINATION ${package}
        COMPONENT development)
