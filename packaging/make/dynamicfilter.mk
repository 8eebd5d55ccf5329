# A run of many recordings in several processes of one machine, by make: it starts the parts and merges
# them, and the same command again repeats only what is missing.
#   make -f /usr/share/dynamicfilter/dynamicfilter.mk -j 4 OUT=clean RECORDINGS='A B "C 1"'
#
# OUT         output folder; plan and parts are in OUT.parts, which may be deleted afterwards
# RECORDINGS  recordings or lists of them, quoted as for a shell
# PARTS       number of parts (16); give several for each process that -j permits
# OPTIONS     options of `dynamicfilter run` and of `dynamicfilter plan`, quoted as for a shell
# RUN         options of `dynamicfilter run` alone, for instance --memory 1.5G
# MERGE       options of `dynamicfilter merge`, for instance --overwrite
# THREADS     threads of each process (1)
# RETRIES     how often a part that fails is tried again at once (1)
PARTS ?= 16
THREADS ?= 1
RETRIES ?= 1
DYNAMICFILTER ?= dynamicfilter
ifeq ($(strip $(OUT)),)
  $(error OUT is missing: give the output folder, as OUT=clean)
endif
ifeq ($(strip $(RECORDINGS)),)
  $(error RECORDINGS is missing: give the recordings, as RECORDINGS='A B')
endif

# No target is a file: each command finds out itself what is done already. So names may have spaces.
# Words of a shell are made of OUT, also if it has quotes.
quoted = '$(subst ','\'',$(1))'
parts := $(shell seq $(PARTS))
folder = $(call quoted,$(OUT).parts)
tasks := $(addprefix part-,$(parts))
.PHONY: merge plan $(tasks)

# 4: done, but some scans were left out, which the command has said.
merge: $(tasks)
	@$(DYNAMICFILTER) merge $(foreach i,$(parts),$(folder)/$(i)-of-$(PARTS)) -o $(call quoted,$(OUT)) $(MERGE) || [ $$? -eq 4 ]

# Reads all recordings once, so that the parts need not.
plan:
	@mkdir -p $(folder)
	@[ -e $(folder)/plan ] || $(DYNAMICFILTER) plan $(RECORDINGS) $(OPTIONS) -o $(folder)/plan

# 2 and 3 are wrong options or recordings, which no repetition helps.
$(tasks): part-%: plan
	@tries=0; until $(DYNAMICFILTER) run $(RECORDINGS) $(OPTIONS) $(RUN) --threads $(THREADS) --plan $(folder)/plan \
	    --part $*/$(PARTS) -o $(folder)/$*-of-$(PARTS) --resume; do \
	    code=$$?; [ $$code -ne 4 ] || exit 0; \
	    tries=$$((tries + 1)); \
	    if [ $$code -eq 2 ] || [ $$code -eq 3 ] || [ $$code -eq 130 ] || [ $$tries -gt $(RETRIES) ]; then exit $$code; fi; \
	    echo "part $* of $(PARTS) failed with code $$code, and is tried again"; \
	done
