# SPDX-License-Identifier: BSD-3-Clause
# The systems that bubblesim is for (docs/systems.md), by ID and VERSION_ID of /etc/os-release. For scripts/setup.
#
#   check_system [FILE]     prints nothing on a tested system and a warning on an untested one; on another it prints what
#                           is wrong and returns 3
#   system_release [FILE]   prints the release: debian-12

check_system() {
  local file=${1:-/etc/os-release} name tested="it is tested on Debian 12 and 13"
  if [[ ! -r $file ]]; then
    echo "there is no $file that names this system: bubblesim needs Debian or Ubuntu; $tested"
    return 3
  fi
  # shellcheck disable=SC1090  # in a shell of its own: the file sets any variables
  name=$(source "$file" && echo "${PRETTY_NAME:-${ID:-a system without a name}}")
  case $(system_release "$file") in
    debian-12 | debian-13) ;;
    ubuntu-24.04)
      echo "bubblesim is untested on $name: $tested; Ubuntu's packages have the same names, as far as known" ;;
    ubuntu-22.04)
      echo "bubblesim does not run on $name: it needs Python 3.11, found 3.10; $tested"
      return 3 ;;
    *)
      echo "bubblesim does not support $name: $tested; --anyway tries Debian's package names here"
      return 3 ;;
  esac
}

# shellcheck disable=SC1090
system_release() {
  local file=${1:-/etc/os-release}
  (source "$file" 2>/dev/null && echo "${ID:-unknown}-${VERSION_ID:-unknown}") || echo unknown
}
