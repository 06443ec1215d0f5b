# Two Debian packages, which `./run package` builds and tries:
#   kcs        the programs with their systemd units, and their settings in /etc/kcs
#   libkcs-dev the libraries, their headers and the contract
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME kcs)
set(CPACK_PACKAGE_VENDOR "the kcs maintainers")
set(CPACK_PACKAGE_CONTACT "the kcs maintainers <kcs@example.com>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL programs service development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# The libraries of Debian that they need, with their versions, are found out when the package is built.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_KCS_PACKAGE_NAME kcs)
set(CPACK_DEBIAN_KCS_PACKAGE_SECTION net)
set(CPACK_DEBIAN_KCS_DESCRIPTION
    "Planner of machine-tool motion: server, command line and machine gateway
 Plans tool paths with limited jerk on every axis, says how long they take, and
 streams setpoints to clients and machines.")
set(CPACK_DEBIAN_KCS_PACKAGE_RECOMMENDS ca-certificates)
set(CPACK_DEBIAN_KCS_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/../package/conffiles
                                                ${CMAKE_CURRENT_LIST_DIR}/../package/postinst)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libkcs-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS 
    "libgrpc++-dev, libprotobuf-dev, libeigen3-dev, libspdlog-dev, libfmt-dev, libtomlplusplus-dev, pkg-config")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
    "Planner of machine-tool motion: libraries for C++
 kcs::client calls a planning server, kcs::planning plans within the process.")

# Outside of a package, nothing is put into /etc.
install(FILES ${PROJECT_SOURCE_DIR}/deploy/kcsd.toml DESTINATION /etc/kcs COMPONENT service EXCLUDE_FROM_ALL)
install(FILES ${PROJECT_SOURCE_DIR}/deploy/gateway.toml ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/doc/kcs
        COMPONENT service EXCLUDE_FROM_ALL)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/deploy/systemd/ DESTINATION lib/systemd/system COMPONENT service EXCLUDE_FROM_ALL)
include(CPack)
cpack_add_component(programs GROUP kcs)
cpack_add_component(service GROUP kcs)
cpack_add_component(development GROUP development)
