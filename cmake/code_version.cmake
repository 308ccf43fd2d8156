# Writes OUTPUT from TEMPLATE. Replaces @version@ by a hash of the files SOURCES (names relative to
# FOLDER, separated by commas) and of EXTRA.
string(REPLACE "," ";" sources "${SOURCES}")
set(all "${EXTRA}")
foreach(source IN LISTS sources)
  file(SHA256 "${FOLDER}/${source}" hash)
  string(APPEND all " ${hash}")
endforeach()
string(SHA256 version "${all}")
configure_file("${TEMPLATE}" "${OUTPUT}" @ONLY)
