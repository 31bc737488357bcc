#!/usr/bin/env bash
# Unpacks and packs the fuzzers' inputs, which are kept as one archive per target, corpus/TARGET.tar.gz:
#
#   bash tests/fuzz/corpus.sh unpack TARGET FOLDER   adds the target's inputs to the folder
#   bash tests/fuzz/corpus.sh pack TARGET FOLDER     makes the archive from the folder's files
#
# The same files make the same archive, bit for bit.
set -euo pipefail

corpus=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)/corpus
usage() {
    sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" >&2
    exit 2
}
[ $# -eq 3 ] || usage
archive=$corpus/$2.tar.gz
case $1 in
    unpack)
        mkdir -p "$3"
        tar -xzf "$archive" -C "$3"
        ;;
    pack)
        [ -n "$(find "$3" -maxdepth 1 -type f -print -quit)" ] || { echo "$3 has no files" >&2 && exit 1; }
        (cd "$3" && find . -maxdepth 1 -type f -printf '%f\0') | LC_ALL=C sort -z |
            tar -C "$3" --mtime=@0 --owner=0 --group=0 --numeric-owner --mode=644 --format=ustar --null -cf - --files-from=- |
            gzip -9n >"$archive.new"
        mv "$archive.new" "$archive"
        ;;
    *) usage ;;
esac
