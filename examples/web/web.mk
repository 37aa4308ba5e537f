# The page that shows what tribox.h answers: build/web/index.html, which opens from a folder, without a server.
# Needs clang with WebAssembly, lld, Node.js and npm (for three, and esbuild, which bundles it).

WEB         := $(B)/web
WEB_CLANG   ?= clang
WEB_MODULES := three@0.187.0 esbuild@0.28.2
WEB_TESTERS := playwright-core@1.65.1 bunny@1.0.1
CHROMIUM    ?= chromium

.PHONY: web web-test

web: $(WEB)/tribox.js $(WEB)/three.bundle.js $(WEB)/index.html $(WEB)/page.css $(WEB)/page.js ## the page with a voxel grid: build/web/index.html
	@wc -c $(WEB)/tribox.js $(WEB)/page.js $(WEB)/page.css $(WEB)/index.html | tail -n 1 | awk '{ print "web: " $$1 " bytes without three" }'
	@echo 'Open $(WEB)/index.html in a browser.'

$(WEB)/%: examples/web/%
	@mkdir -p $(WEB)
	cp $< $@

$(WEB)/tribox.wasm: examples/web/tribox_web.c examples/web/libc/libc.h $(wildcard examples/*.h) tribox.h
	@mkdir -p $(WEB)
	$(WEB_CLANG) --target=wasm32 -std=c99 -Os -msimd128 -mbulk-memory -nostdlib -ffreestanding -nostdlibinc \
	    -isystem examples/web/libc -I. -Wl,--no-entry -Wl,--strip-all $< -o $@

$(WEB)/tribox.js: $(WEB)/tribox.wasm
	{ printf "const TRIBOX_WASM = '"; base64 $< | tr -d '\n'; printf "';\n"; } > $@

$(WEB)/node_modules/.modules: examples/web/web.mk
	@mkdir -p $(WEB)
	cd $(WEB) && npm install --silent --no-save --no-fund --no-audit $(WEB_MODULES) $(WEB_TESTERS)
	touch $@

$(WEB)/three.bundle.js: examples/web/three.js $(WEB)/node_modules/.modules
	NODE_PATH=$(WEB)/node_modules $(WEB)/node_modules/.bin/esbuild $< --bundle --minify --format=iife --global-name=THREE \
	    --log-level=warning --outfile=$@

web-test: web $(B)/voxelize ## drive the page in Chromium: drag, keys, files; its voxels are the native program's
	@if ! command -v $(CHROMIUM) > /dev/null; then echo 'SKIP: $(CHROMIUM) not found'; exit 0; fi; \
	node bench/bunny_to_ply.js $(WEB)/node_modules/bunny/index.js > $(WEB)/bunny.ply && \
	NODE_PATH=$(WEB)/node_modules node examples/web/test.js $(WEB) $(B)/voxelize $$(command -v $(CHROMIUM))
