(* SPDX-License-Identifier: MIT *)
(* Where the condition `holds` of solve_plain is true, no result of it is infinite or NaN, and all are in the ranges
   that the error bound asks for. *)
From Coq Require Import Reals Lra Psatz ZArith String List Bool.
From Flocq Require Import Core BinarySingleNaN.
From Swivel Require Import Rotors Products Elbow Wrist Rounding Near Turns Length Arm Bend Plane Lengths Operations
  Program.
Open Scope R_scope.
Open Scope string_scope.

(* what the program says of a name *)
Fixpoint lookup (name : string) (lines : list (string * operation)) : option operation :=
  match lines with
  | nil => None
  | cons (n, o) rest => if String.eqb name n then Some o else lookup name rest
  end.
Lemma line_of e lines name o : runs e lines -> lookup name lines = Some o -> computes e (name, o).
Proof.
  induction lines as [|[n o'] rest IH]; intros R L. discriminate.
  simpl in R. destruct R as [C R]. simpl in L. destruct (String.eqb name n) eqn:Q.
  - apply String.eqb_eq in Q. subst n. injection L as <-. exact C.
  - now apply IH.
Qed.

Section Holds.
Variable e : environment.
Hypothesis run : runs e program.
Hypothesis finite_inputs : forall n, In n inputs -> is_finite (e n) = true.
Hypothesis hold : truth e holds = true.
Notation "# n" := (B2R (e n)) (at level 1, format "# n").
Notation finite n := (is_finite (e n) = true).
Notation size n := (Rabs #n).

(* E: the program's equation of a name *)
Tactic Notation "line" constr(name) "as" ident(E) := pose proof (line_of e program name _ run eq_refl) as E;
  cbn [computes] in E.

Ltac input := apply finite_inputs; simpl; tauto.
Lemma i_w1 : finite "w1". Proof. input. Qed.
Lemma i_w2 : finite "w2". Proof. input. Qed.
Lemma i_w3 : finite "w3". Proof. input. Qed.
Lemma i_p1 : finite "p1". Proof. input. Qed.
Lemma i_p2 : finite "p2". Proof. input. Qed.
Lemma i_p3 : finite "p3". Proof. input. Qed.
Lemma i_upper : finite "upper". Proof. input. Qed.
Lemma i_fore : finite "fore". Proof. input. Qed.

(* the four conditions *)
Lemma conditions : Bleb (e "kPlainLeast") (e "lesser") = true /\ Bleb (e "total") (e "kPlainMost") = true /\
  Bltb (e "off") (e "normal_length") = true /\ Bleb (e "kPlainLeast") (e "bones_least") = true.
Proof. pose proof hold as H. cbn [truth holds] in H. apply andb_prop in H as [H H4]. apply andb_prop in H as [H H3].
  apply andb_prop in H as [H1 H2]. auto. Qed.
Lemma least : finite "kPlainLeast" /\ #"kPlainLeast" = 9007199 / 9007199254740992.
Proof. line "kPlainLeast" as E. destruct E as [F V]. split. exact F. rewrite V. unfold F2R. simpl. lra. Qed.
Lemma most : finite "kPlainMost" /\ #"kPlainMost" = 35000000.
Proof. line "kPlainMost" as E. destruct E as [F V]. split. exact F. rewrite V. unfold F2R. simpl. lra. Qed.

(* ---- from the conditions back to their numbers *)
Lemma nn_wrist2 : not_negative (e "wrist2").
Proof.
  line "wrist2" as E. rewrite E. apply add_not_negative.
  - line "w12" as E1. rewrite E1. apply add_not_negative. line "w11" as E2. rewrite E2.
    apply square_not_negative, i_w1. line "w22" as E2. rewrite E2. apply square_not_negative, i_w2.
  - line "w33" as E1. rewrite E1. apply square_not_negative, i_w3.
Qed.
Lemma nn_pole1 : not_negative (e "pole1").
Proof.
  line "pole1" as E. rewrite E. apply add_not_negative.
  - line "p12" as E1. rewrite E1. apply add_not_negative. line "abs_p1" as E2. rewrite E2.
    apply abs_not_negative, i_p1. line "abs_p2" as E2. rewrite E2. apply abs_not_negative, i_p2.
  - line "abs_p3" as E1. rewrite E1. apply abs_not_negative, i_p3.
Qed.
Lemma nn_wrist_pole : not_negative (e "wrist_pole").
Proof. line "wrist_pole" as E. rewrite E. apply add_not_negative. apply nn_wrist2. apply nn_pole1. Qed.
Lemma bones_not_infinite : e "shortest2" <> B754_infinity true.
Proof.
  intro H. destruct conditions as [_ [_ [_ C]]]. destruct least as [F _]. line "bones_least" as E. rewrite E in C.
    cbn [truth] in C. rewrite H in C.
  pose proof (lo_minus_infinity (e "kPlainLeast") (e "lift_least") F) as L. unfold lo in L. rewrite L in C.
    discriminate.
Qed.
Lemma f_far : finite "far".
Proof.
  line "far" as E. destruct (add_overflow _ _ i_upper i_fore) as [F|[V _]]. rewrite E. exact F.
  exfalso. rewrite <- E in V. destruct (Bsign (e "upper")).
  - (* minus infinity less a size is minus infinity *)
    apply bones_not_infinite. line "shortest2" as E1. line "near" as E2. line "diff" as E3. rewrite E1, V, E2.
    destruct (sub_overflow _ _ i_upper i_fore) as [F|[V' _]].
    + rewrite <- E3 in F. destruct (e "diff") as [s|s| |s m x B]; try discriminate; reflexivity.
    + rewrite <- E3 in V'. rewrite V'. reflexivity.
  - (* plus infinity is more than kPlainMost *)
    destruct conditions as [_ [C _]]. line "total" as E1. rewrite E1, V in C. pose proof nn_wrist_pole as N.
      destruct most as [F _].
    destruct (e "wrist_pole") as [s|[|]| |[|] m x B]; simpl in N; try contradiction;
      destruct (e "kPlainMost") as [s'|s'| |s' m' x' B']; try discriminate.
Qed.
Lemma f_diff : finite "diff".
Proof.
  line "diff" as E. destruct (sub_overflow _ _ i_upper i_fore) as [F|[V _]]. rewrite E. exact F.
  exfalso. rewrite <- E in V. apply bones_not_infinite. line "shortest2" as E1. line "near" as E2. rewrite E1, E2, V.
    pose proof f_far as F.
  destruct (e "far") as [s|s| |s m x B]; try discriminate; reflexivity.
Qed.
Lemma f_near : finite "near". Proof. line "near" as E. rewrite E, is_finite_Babs. apply f_diff. Qed.
Lemma f_shortest2 : finite "shortest2".
Proof.
  line "shortest2" as E. destruct (sub_overflow _ _ f_far f_near) as [F|[V S]]. rewrite E. exact F.
  exfalso. apply bones_not_infinite. rewrite E, V. line "near" as E1. rewrite E1, Bsign_Babs in S. rewrite S.
    reflexivity.
Qed.
Lemma v_near : #"near" = Rabs #"diff". Proof. line "near" as E. rewrite E. apply B2R_Babs. Qed.
Lemma v_shortest2 : #"shortest2" = fl32 (#"far" - #"near").
Proof. line "shortest2" as E. rewrite E. apply finite_difference. apply f_far. apply f_near. rewrite <- E.
  apply f_shortest2. Qed.
Lemma v_far : #"far" = fl32 (#"upper" + #"fore").
Proof. line "far" as E. rewrite E. apply finite_sum. apply i_upper. apply i_fore. rewrite <- E. apply f_far. Qed.
Lemma v_diff : #"diff" = fl32 (#"upper" - #"fore").
Proof. line "diff" as E. rewrite E. apply finite_difference. apply i_upper. apply i_fore. rewrite <- E. apply f_diff.
  Qed.
Lemma shortest2_least : 9.99e-10 <= #"shortest2".
Proof.
  destruct conditions as [_ [_ [_ C]]]. destruct least as [F V]. line "bones_least" as E. rewrite E in C.
    cbn [truth] in C.
  pose proof (lo_first _ _ _ F f_shortest2 C) as L. rewrite V in L. lra.
Qed.
Lemma bones_apart : 9.9e-10 <= #"far" - #"near".
Proof.
  pose proof shortest2_least as H. rewrite v_shortest2 in H.
  destruct (relative_difference _ _ (float_value (e "far")) (float_value (e "near"))) as [x [K Q]]. rewrite Q in H.
    apply ok_low in K. rewrite u_val in K.
  destruct (Rle_lt_dec (9.9e-10) (#"far" - #"near")) as [L|L]; [exact L|exfalso].
  destruct (Rle_lt_dec 0 (#"far" - #"near")) as [P|P].
  - assert ((#"far" - #"near") * (1 + x) <= 9.9e-10 * 1.0000001) by (apply Rmult_le_compat; lra). lra.
  - assert (0 <= - (#"far" - #"near") * (1 + x)) by (apply Rmult_le_pos; lra). lra.
Qed.
Lemma bones_positive : 0 < #"upper" /\ 0 < #"fore".
Proof.
  pose proof bones_apart as H. rewrite v_near in H. pose proof v_far as F. pose proof v_diff as D.
  split; apply Rnot_le_lt; intro L.
  - assert (#"far" <= fl32 (- (#"upper" - #"fore"))) by (rewrite F; apply fl_le; lra). rewrite fl_opp, <- D in H0.
    pose proof (Rle_abs (- #"diff")). rewrite Rabs_Ropp in H1. lra.
  - assert (#"far" <= #"diff") by (rewrite F, D; apply fl_le; lra). pose proof (Rle_abs #"diff"). lra.
Qed.
Lemma far_positive : 9.9e-10 <= #"far".
Proof. pose proof bones_apart. rewrite v_near in H. pose proof (Rabs_pos #"diff"). lra. Qed.
Lemma f_wrist_pole : finite "wrist_pole".
Proof.
  pose proof nn_wrist_pole as N. destruct conditions as [_ [C _]]. line "total" as E. rewrite E in C.
    pose proof f_far as F. destruct most as [Fm _].
  destruct (e "wrist_pole") as [s|[|]| |[|] m x B]; simpl in N; try contradiction; try reflexivity. exfalso.
  destruct (e "far") as [s'|s'| |s' m' x' B']; try discriminate;
    destruct (e "kPlainMost") as [s''|s''| |s'' m'' x'' B'']; try discriminate.
Qed.
Lemma f_total : finite "total".
Proof.
  line "total" as E. destruct (add_overflow _ _ f_wrist_pole f_far) as [F|[V S]]. rewrite E. exact F.
  exfalso. pose proof (sign_of_abs _ f_far) as P. unfold sign_of in P. pose proof far_positive as Q.
    rewrite (Rabs_right #"far") in P by lra. rewrite <- S in P.
  destruct (Bsign (e "wrist_pole")). lra. destruct conditions as [_ [C _]]. rewrite E, V in C. destruct most as [Fm _].
  destruct (e "kPlainMost") as [s''|s''| |s'' m'' x'' B'']; try discriminate.
Qed.
Lemma f_wrist2 : finite "wrist2". Proof. line "wrist_pole" as E. pose proof f_wrist_pole as F. rewrite E in F.
  now apply add_finite in F. Qed.
Lemma f_pole1 : finite "pole1". Proof. line "wrist_pole" as E. pose proof f_wrist_pole as F. rewrite E in F.
  now apply add_finite in F. Qed.
Lemma f_w12 : finite "w12" /\ finite "w33". Proof. line "wrist2" as E. pose proof f_wrist2 as F. rewrite E in F.
  now apply add_finite in F. Qed.
Lemma f_w11 : finite "w11" /\ finite "w22". Proof. line "w12" as E. destruct f_w12 as [F _]. rewrite E in F.
  now apply add_finite in F. Qed.
Lemma f_p12 : finite "p12". Proof. line "pole1" as E. pose proof f_pole1 as F. rewrite E in F.
  now apply add_finite in F. Qed.
Lemma v_w11 : #"w11" = fl32 (#"w1" * #"w1"). Proof. line "w11" as E. destruct f_w11 as [F _]. rewrite E in *.
  apply finite_product; try exact F; apply i_w1. Qed.
Lemma v_w22 : #"w22" = fl32 (#"w2" * #"w2"). Proof. line "w22" as E. destruct f_w11 as [_ F]. rewrite E in *.
  apply finite_product; try exact F; apply i_w2. Qed.
Lemma v_w33 : #"w33" = fl32 (#"w3" * #"w3"). Proof. line "w33" as E. destruct f_w12 as [_ F]. rewrite E in *.
  apply finite_product; try exact F; apply i_w3. Qed.
Lemma v_w12 : #"w12" = fl32 (#"w11" + #"w22"). Proof. line "w12" as E. destruct f_w12 as [F _]. rewrite E in *.
  apply finite_sum; try exact F; apply f_w11. Qed.
Lemma v_wrist2 : #"wrist2" = fl32 (#"w12" + #"w33"). Proof. line "wrist2" as E. pose proof f_wrist2 as F.
  rewrite E in *. apply finite_sum; try exact F; apply f_w12. Qed.
Lemma u_abs n m k : e n = Babs (e m) -> upto k (e m) -> upto k (e n) /\ #n = size m.
Proof. intros -> U. now apply abs_upto. Qed.
Lemma v_abs n m : e n = Babs (e m) -> #n = size m.
Proof. intros ->. apply B2R_Babs. Qed.
Lemma v_p12 : #"p12" = fl32 (size "p1" + size "p2").
Proof. line "p12" as E. pose proof f_p12 as F. line "abs_p1" as E1. line "abs_p2" as E2.
  rewrite <- (v_abs _ _ E1), <- (v_abs _ _ E2). rewrite E in *. apply finite_sum; try exact F.
  rewrite E1, is_finite_Babs; apply i_p1. rewrite E2, is_finite_Babs; apply i_p2. Qed.
Lemma v_pole1 : #"pole1" = fl32 (#"p12" + size "p3").
Proof. line "pole1" as E. pose proof f_pole1 as F. line "abs_p3" as E1. rewrite <- (v_abs _ _ E1). rewrite E in *.
  apply finite_sum; try exact F. apply f_p12. rewrite E1, is_finite_Babs; apply i_p3. Qed.
Lemma v_wrist_pole : #"wrist_pole" = fl32 (#"wrist2" + #"pole1").
Proof. line "wrist_pole" as E. pose proof f_wrist_pole as F. rewrite E in *. apply finite_sum; try exact F.
  apply f_wrist2. apply f_pole1. Qed.
Lemma v_total : #"total" = fl32 (#"wrist_pole" + #"far").
Proof. line "total" as E. pose proof f_total as F. rewrite E in *. apply finite_sum; try exact F. apply f_wrist_pole.
  apply f_far. Qed.
Lemma wrist_pole_least : 9.99e-10 <= #"wrist2" /\ 9.99e-10 <= #"pole1".
Proof.
  destruct conditions as [C _]. destruct least as [F V]. line "lesser" as E. rewrite E in C. cbn [truth] in C.
  pose proof (lo_first _ _ _ F f_wrist2 C) as L1. pose proof (lo_second _ _ _ F f_wrist2 f_pole1 C) as L2.
    rewrite V in *. lra.
Qed.
Lemma sums_most : #"wrist2" + #"pole1" <= 3.5001e7 /\ #"far" <= 3.5e7.
Proof.
  destruct conditions as [_ [C _]]. destruct most as [F V]. apply le_true in C; try assumption; try apply f_total.
    rewrite V, v_total in C.
  destruct wrist_pole_least as [L1 L2]. pose proof far_positive as P.
  assert (Q : 0 <= #"wrist_pole") by (rewrite v_wrist_pole; apply fl_pos; lra).
  assert (A : #"wrist_pole" <= 35000000). { apply Rle_trans with (2 := C).
    rewrite <- (fl_float #"wrist_pole") at 1 by apply float_value. apply fl_le. lra. }
  split.
  - rewrite v_wrist_pole in A. destruct (relative_sum _ _ (float_value (e "wrist2")) (float_value (e "pole1"))) as [x
    [K E]]. rewrite E in A. apply ok_low in K. rewrite u_val in K.
    assert ((#"wrist2" + #"pole1") * 0.9999999 <= (#"wrist2" + #"pole1") * (1 + x)) by (apply Rmult_le_compat_l; lra).
      lra.
  - assert (#"far" <= 35000000). { apply Rle_trans with (2 := C).
    rewrite <- (fl_float #"far") at 1 by apply float_value. apply fl_le. lra. } lra.
Qed.

(* ---- forward: the plane *)
Lemma v_length : upto 26 (e "length") /\ #"length" = fl32 (sqrt #"wrist2").
Proof.
  line "length" as E. rewrite E. destruct wrist_pole_least. destruct sums_most. apply root_exact. apply f_wrist2. lra.
    lia. simpl (bpow _ _). lra.
Qed.
Lemma v_abs_w3 : finite "abs_w3" /\ #"abs_w3" = size "w3".
Proof. line "abs_w3" as E. rewrite E, is_finite_Babs. split. apply i_w3. apply B2R_Babs. Qed.
Let l := sqrt (#"w1" * #"w1" + #"w2" * #"w2" + #"w3" * #"w3").
Lemma l_most : 3e-5 <= l /\ l <= 6000.
Proof.
  destruct wrist_pole_least as [L1 L2]. destruct sums_most as [M _].
  pose proof (l_least _ _ _ _ _ _ _ _ v_w11 v_w22 v_w12 v_w33 v_wrist2 ltac:(lra)) as L. fold l in L. split. lra.
  destruct (wrist2_near _ _ _ _ _ _ _ _ v_w11 v_w22 v_w12 v_w33 v_wrist2 ltac:(lra)) as [N _]. apply near_bounds in N.
  unfold l. rewrite <- (sqrt_square 6000) by lra. apply sqrt_le_1_alt. lra.
Qed.
Lemma size_w n : #n * #n <= #"w1" * #"w1" + #"w2" * #"w2" + #"w3" * #"w3" -> finite n -> upto 13 (e n).
Proof.
  intros H F. split. exact F. apply sqr_le_abs. simpl; lra. apply Rle_trans with (1 := H). destruct l_most as [L1 L2].
  assert (E : l * l = #"w1" * #"w1" + #"w2" * #"w2" + #"w3" * #"w3"). { apply sqrt_sqrt. pose proof (sqr_pos #"w1").
    pose proof (sqr_pos #"w2"). pose proof (sqr_pos #"w3"). lra. }
  rewrite <- E. simpl (bpow _ _). apply Rmult_le_compat; lra.
Qed.
Lemma u_w1 : upto 13 (e "w1"). Proof. apply size_w. pose proof (sqr_pos #"w2"). pose proof (sqr_pos #"w3"). lra.
  apply i_w1. Qed.
Lemma u_w2 : upto 13 (e "w2"). Proof. apply size_w. pose proof (sqr_pos #"w1"). pose proof (sqr_pos #"w3"). lra.
  apply i_w2. Qed.
Lemma u_w3 : upto 13 (e "w3"). Proof. apply size_w. pose proof (sqr_pos #"w1"). pose proof (sqr_pos #"w2"). lra.
  apply i_w3. Qed.
Lemma u_length : upto 13 (e "length").
Proof.
  destruct v_length as [[F _] V]. split. exact F. destruct wrist_pole_least as [L1 _]. destruct l_most as [L2 L3].
  pose proof (length_near _ _ _ _ _ _ _ _ _ v_w11 v_w22 v_w12 v_w33 v_wrist2 V ltac:(lra)) as N. fold l in N.
    apply near_bounds in N. apply Rabs_le. simpl (bpow _ _). lra.
Qed.
Lemma v_height : upto 14 (e "height") /\ #"height" = fl32 (#"length" + size "w3").
Proof.
  line "height" as E. rewrite E. destruct v_abs_w3 as [F V]. rewrite <- V. apply (add_upto _ _ 13). apply u_length.
    split. exact F. rewrite V, Rabs_Rabsolu. apply u_w3. lia.
Qed.
Lemma pole_size : size "p1" <= 3.6e7 /\ size "p2" <= 3.6e7 /\ size "p3" <= 3.6e7.
Proof.
  destruct sums_most as [M _]. destruct wrist_pole_least as [L _].
  pose proof (pole1_near _ _ _ (float_value _) (float_value _) (float_value _) _ _ v_p12 v_pole1) as N.
    apply near_bounds in N.
  pose proof (Rabs_pos #"p1"). pose proof (Rabs_pos #"p2"). pose proof (Rabs_pos #"p3"). lra.
Qed.
Lemma u_p1 : upto 26 (e "p1"). Proof. split. apply i_p1. simpl (bpow _ _). pose proof pole_size. lra. Qed.
Lemma u_p2 : upto 26 (e "p2"). Proof. split. apply i_p2. simpl (bpow _ _). pose proof pole_size. lra. Qed.
Lemma u_p3 : upto 26 (e "p3"). Proof. split. apply i_p3. simpl (bpow _ _). pose proof pole_size. lra. Qed.
Lemma u_pole1 : upto 26 (e "pole1").
Proof. split. apply f_pole1. destruct sums_most as [M _]. destruct wrist_pole_least as [L1 L2].
  rewrite Rabs_right by lra. simpl (bpow _ _). lra. Qed.

(* one operation: what it is, and its size from the sizes of what it takes *)
Lemma op_mul n a b i j k : e n = mul (e a) (e b) -> upto i (e a) -> upto j (e b) -> (-149 <= i + j <= k)%Z ->
  (k < 128)%Z -> upto k (e n) /\ #n = fl32 (#a * #b).
Proof. intros -> A B H K. destruct (mul_upto _ _ _ _ A B) as [U V]. lia. split. now apply upto_le with (1 := U).
  exact V. Qed.
Lemma op_add n a b i k : e n = add (e a) (e b) -> upto i (e a) -> upto i (e b) -> (-149 <= i < k)%Z -> (k < 128)%Z ->
  upto k (e n) /\ #n = fl32 (#a + #b).
Proof. intros -> A B H K. destruct (add_upto _ _ _ A B) as [U V]. lia. split. apply upto_le with (1 := U). lia.
  exact V. Qed.
Lemma op_sub n a b i k : e n = sub (e a) (e b) -> upto i (e a) -> upto i (e b) -> (-149 <= i < k)%Z -> (k < 128)%Z ->
  upto k (e n) /\ #n = fl32 (#a - #b).
Proof. intros -> A B H K. destruct (sub_upto _ _ _ A B) as [U V]. lia. split. apply upto_le with (1 := U). lia.
  exact V. Qed.
Ltac known L := first [exact L | exact (proj1 L) | eapply upto_le; [first [exact L | exact (proj1 L)] | lia]].
Tactic Notation "product" constr(name) "of" constr(A) constr(B) := let E := fresh "E" in line name as E; eapply op_mul;
  [exact E | known A | known B | lia | lia].
Tactic Notation "sum" constr(name) "of" constr(A) constr(B) := let E := fresh "E" in line name as E; eapply op_add;
  [exact E | known A | known B | lia | lia].
Tactic Notation "difference" constr(name) "of" constr(A) constr(B) := let E := fresh "E" in line name as E;
  eapply op_sub; [exact E | known A | known B | lia | lia].

Lemma v_p2w1 : upto 39 (e "p2w1") /\ #"p2w1" = fl32 (#"p2" * #"w1"). Proof. product "p2w1" of u_p2 u_w1. Qed.
Lemma v_p1w2 : upto 39 (e "p1w2") /\ #"p1w2" = fl32 (#"p1" * #"w2"). Proof. product "p1w2" of u_p1 u_w2. Qed.
Lemma v_p1w3 : upto 39 (e "p1w3") /\ #"p1w3" = fl32 (#"p1" * #"w3"). Proof. product "p1w3" of u_p1 u_w3. Qed.
Lemma v_p3w1 : upto 39 (e "p3w1") /\ #"p3w1" = fl32 (#"p3" * #"w1"). Proof. product "p3w1" of u_p3 u_w1. Qed.
Lemma v_p3w2 : upto 39 (e "p3w2") /\ #"p3w2" = fl32 (#"p3" * #"w2"). Proof. product "p3w2" of u_p3 u_w2. Qed.
Lemma v_p2w3 : upto 39 (e "p2w3") /\ #"p2w3" = fl32 (#"p2" * #"w3"). Proof. product "p2w3" of u_p2 u_w3. Qed.
Lemma v_nz : upto 40 (e "nz") /\ #"nz" = fl32 (#"p2w1" - #"p1w2"). Proof. difference "nz" of v_p2w1 v_p1w2. Qed.
Lemma v_ny : upto 40 (e "ny") /\ #"ny" = fl32 (#"p1w3" - #"p3w1"). Proof. difference "ny" of v_p1w3 v_p3w1. Qed.
Lemma v_nx : upto 40 (e "nx") /\ #"nx" = fl32 (#"p3w2" - #"p2w3"). Proof. difference "nx" of v_p3w2 v_p2w3. Qed.
Lemma v_nxx : upto 80 (e "nxx") /\ #"nxx" = fl32 (#"nx" * #"nx"). Proof. product "nxx" of v_nx v_nx. Qed.
Lemma v_nyy : upto 80 (e "nyy") /\ #"nyy" = fl32 (#"ny" * #"ny"). Proof. product "nyy" of v_ny v_ny. Qed.
Lemma v_nzz : upto 80 (e "nzz") /\ #"nzz" = fl32 (#"nz" * #"nz"). Proof. product "nzz" of v_nz v_nz. Qed.
Lemma v_nxy : upto 81 (e "nxy") /\ #"nxy" = fl32 (#"nxx" + #"nyy"). Proof. sum "nxy" of v_nxx v_nyy. Qed.
Lemma v_normal2 : upto 82 (e "normal2") /\ #"normal2" = fl32 (#"nxy" + #"nzz"). Proof. sum "normal2" of v_nxy v_nzz.
  Qed.
Lemma fl_square x : 0 <= fl32 (x * x). Proof. apply fl_pos, sqr_pos. Qed.
Lemma normal2_pos : 0 <= #"normal2".
Proof.
  rewrite (proj2 v_normal2), (proj2 v_nxy), (proj2 v_nxx), (proj2 v_nyy), (proj2 v_nzz).
    apply fl_pos, Rplus_le_le_0_compat; [apply fl_pos, Rplus_le_le_0_compat|]; apply fl_square.
Qed.
Lemma v_normal_length : upto 82 (e "normal_length") /\ #"normal_length" = fl32 (sqrt #"normal2").
Proof. line "normal_length" as E. rewrite E. destruct v_normal2 as [[F B] _]. apply root_exact. exact F.
  apply normal2_pos. lia. apply Rle_trans with (2 := B). apply Rle_abs. Qed.
Lemma v_kPoleOff : upto 0 (e "kPoleOff") /\ #"kPoleOff" = 8589935 / 8589934592.
Proof. line "kPoleOff" as E. destruct E as [F V]. assert (Q : #"kPoleOff" = 8589935 / 8589934592) by (rewrite V;
  unfold F2R; simpl; lra). repeat split. exact F. rewrite Q. rewrite Rabs_right; simpl; lra. exact Q. Qed.
Lemma v_length_pole : upto 39 (e "length_pole") /\ #"length_pole" = fl32 (#"length" * #"pole1"). Proof.
  product "length_pole" of u_length u_pole1. Qed.
Lemma v_off : upto 39 (e "off") /\ #"off" = fl32 (#"kPoleOff" * #"length_pole"). Proof.
  product "off" of v_kPoleOff v_length_pole. Qed.
Lemma off_below : #"off" < #"normal_length".
Proof. destruct conditions as [_ [_ [C _]]]. apply lt_true in C; try exact C. apply v_off. apply v_normal_length. Qed.

Lemma v_per : upto 30 (e "per_length2") /\ 1/2 <= #"per_length2" * #"wrist2" <= 1.
Proof.
  line "per_length2" as E. destruct wrist_pole_least as [L _]. destruct E as [F V]. apply f_wrist2. simpl (bpow _ _).
    lra.
  destruct (mag radix2 #"wrist2") as [k K]. cbn [mag_val] in V. specialize (K ltac:(lra)).
    rewrite (Rabs_right #"wrist2") in K by lra. destruct K as [K1 K2].
  assert (P : #"per_length2" * bpow radix2 k = 1) by (rewrite V, <- bpow_plus; replace (- k + k)%Z with 0%Z by lia;
    reflexivity).
  assert (Pp : 0 < #"per_length2") by (rewrite V; apply bpow_gt_0).
  assert (K3 : bpow radix2 k = 2 * bpow radix2 (k - 1)) by (replace k with (1 + (k - 1))%Z at 1 by lia;
    rewrite bpow_plus; reflexivity).
  assert (Q1 : #"per_length2" * bpow radix2 (k - 1) <= #"per_length2" * #"wrist2") by (apply Rmult_le_compat_l; lra).
  assert (Q2 : #"per_length2" * #"wrist2" <= #"per_length2" * bpow radix2 k) by (apply Rmult_le_compat_l; lra).
  pose proof P as P'. rewrite K3 in P'. repeat split; try lra. exact F. rewrite Rabs_right by lra. simpl (bpow _ _).
  assert (#"per_length2" * 9.99e-10 <= #"per_length2" * #"wrist2") by (apply Rmult_le_compat_l; lra). lra.
Qed.
Lemma v_mx : upto 70 (e "mx") /\ #"mx" = fl32 (#"per_length2" * #"nx"). Proof. product "mx" of v_per v_nx. Qed.
Lemma v_my : upto 70 (e "my") /\ #"my" = fl32 (#"per_length2" * #"ny"). Proof. product "my" of v_per v_ny. Qed.
Lemma v_mz : upto 70 (e "mz") /\ #"mz" = fl32 (#"per_length2" * #"nz"). Proof. product "mz" of v_per v_nz. Qed.
Let sg := sign_of (e "w3").
Lemma v_along : upto 70 (e "along") /\ #"along" = sg * #"mz". Proof. line "along" as E. rewrite E. apply flip_upto.
  apply v_mz. Qed.
Lemma along_side : #"along" = #"mz" \/ #"along" = - #"mz".
Proof. rewrite (proj2 v_along). destruct (sign_of_1 (e "w3")) as [S|S]; unfold sg; rewrite S; [left|right]; ring. Qed.
Lemma v_hx : upto 84 (e "hx") /\ #"hx" = fl32 (#"height" * #"mx"). Proof. product "hx" of v_height v_mx. Qed.
Lemma v_hy : upto 84 (e "hy") /\ #"hy" = fl32 (#"height" * #"my"). Proof. product "hy" of v_height v_my. Qed.
Lemma v_along1 : upto 83 (e "along1") /\ #"along1" = fl32 (#"along" * #"w1"). Proof. product "along1" of v_along u_w1.
  Qed.
Lemma v_along2 : upto 83 (e "along2") /\ #"along2" = fl32 (#"along" * #"w2"). Proof. product "along2" of v_along u_w2.
  Qed.
Lemma v_c : upto 85 (e "c") /\ #"c" = fl32 (#"along1" - #"hx"). Proof. line "c" as E. apply (op_sub _ _ _ 84 _ E).
  known v_along1. known v_hx. lia. lia. Qed.
Lemma v_s : upto 85 (e "s") /\ #"s" = fl32 (#"along2" - #"hy"). Proof. line "s" as E. apply (op_sub _ _ _ 84 _ E).
  known v_along2. known v_hy. lia. lia. Qed.
Lemma v_per_normal : upto 112 (e "per_normal") /\ #"per_normal" = fl32 (#"per_length2" * #"normal_length"). Proof.
  product "per_normal" of v_per v_normal_length. Qed.
Lemma v_spread : upto 126 (e "spread") /\ #"spread" = fl32 (#"per_normal" * #"height"). Proof.
  product "spread" of v_per_normal v_height. Qed.
Lemma v_abs_c : upto 85 (e "abs_c") /\ #"abs_c" = size "c". Proof. line "abs_c" as E. apply (u_abs _ _ _ E). apply v_c.
  Qed.
(* ---- the facts so far, for the lemmas about ranges *)
Local Opaque fl32.
Lemma v_off_const : #"off" = fl32 (8589935 / 8589934592 * #"length_pole").
Proof. rewrite <- (proj2 v_kPoleOff). apply v_off. Qed.
Ltac fact := first [apply float_value | exact v_w11 | exact v_w22 | exact v_w12 | exact v_w33 | exact v_wrist2 | exact
  (proj2 v_length) | exact (proj2 v_height)
  | exact v_p12 | exact v_pole1 | exact (proj2 v_p2w1) | exact (proj2 v_p1w2) | exact (proj2 v_nz) | exact (proj2
    v_p1w3) | exact (proj2 v_p3w1) | exact (proj2 v_ny)
  | exact (proj2 v_p3w2) | exact (proj2 v_p2w3) | exact (proj2 v_nx) | exact (proj2 v_nxx) | exact (proj2 v_nyy) |
    exact (proj2 v_nxy) | exact (proj2 v_nzz) | exact (proj2 v_normal2)
  | exact (proj2 v_normal_length) | exact (proj2 v_length_pole) | exact v_off_const | exact off_below | exact (proj2
    v_per) | exact (proj2 v_mx) | exact (proj2 v_my) | exact (proj2 v_mz)
  | exact along_side | exact (proj2 v_hx) | exact (proj2 v_hy) | exact (proj2 v_along1) | exact (proj2 v_along2) |
    exact (proj2 v_c) | exact (proj2 v_s)
  | exact (proj2 v_per_normal) | exact (proj2 v_spread) | lra].
Ltac plane := destruct wrist_pole_least as [Least1 Least2]; destruct sums_most as [Most1 Most2].
Lemma s_size : size "s" <= 2.004 * #"pole1".
Proof. plane. eapply s_most with (w1 := #"w1") (w2 := #"w2") (w3 := #"w3") (p1 := #"p1") (p2 := #"p2") (p3 := #"p3");
  fact. Qed.
Lemma v_large : upto 127 (e "large") /\ #"large" = fl32 (#"spread" + size "c").
Proof. rewrite <- (proj2 v_abs_c). sum "large" of v_spread v_abs_c. Qed.
Lemma large_size : 4.6e-4 * #"pole1" <= #"large" <= 4.01 * #"pole1".
Proof. plane. eapply large_range with (w1 := #"w1") (w2 := #"w2") (w3 := #"w3") (p1 := #"p1") (p2 := #"p2") (p3 :=
  #"p3"); first [exact (proj2 v_large) | fact]. Qed.
Lemma u_s : upto 28 (e "s").
Proof. plane. split. apply v_s. pose proof s_size. simpl (bpow _ _). lra. Qed.
Lemma u_large : upto 28 (e "large").
Proof. plane. split. apply v_large. pose proof large_size. rewrite Rabs_right by lra. simpl (bpow _ _). lra. Qed.
Lemma v_ss : upto 56 (e "ss") /\ #"ss" = fl32 (#"s" * #"s"). Proof. product "ss" of u_s u_s. Qed.
Lemma v_large_large : upto 56 (e "large_large") /\ #"large_large" = fl32 (#"large" * #"large"). Proof.
  product "large_large" of u_large u_large. Qed.
Lemma v_twist_len2 : upto 57 (e "twist_len2") /\ #"twist_len2" = fl32 (#"large_large" + #"ss"). Proof.
  sum "twist_len2" of v_large_large v_ss. Qed.
Lemma twist_near : near 1.193e-7 #"twist_len2" (#"large" * #"large" + #"s" * #"s").
Proof. plane. eapply twist2_near with (w1 := #"w1") (w2 := #"w2") (w3 := #"w3") (p1 := #"p1") (p2 := #"p2") (p3 :=
  #"p3");
  first [exact (proj2 v_large) | exact (proj2 v_ss) | exact (proj2 v_large_large) | exact (proj2 v_twist_len2) | fact].
    Qed.
Lemma twist_size : 1.9e-7 * (#"pole1" * #"pole1") <= #"twist_len2" <= 20.3 * (#"pole1" * #"pole1").
Proof. plane. eapply twist2_range with (w1 := #"w1") (w2 := #"w2") (w3 := #"w3") (p1 := #"p1") (p2 := #"p2") (p3 :=
  #"p3");
  first [exact (proj2 v_large) | exact (proj2 v_ss) | exact (proj2 v_large_large) | exact (proj2 v_twist_len2) | fact].
    Qed.

(* ---- the triangle *)
Lemma v_distance : finite "distance" /\ #"distance" = Rmin (Rmax #"length" (Rabs #"diff")) #"far".
Proof.
  line "distance" as E. line "not_near" as E1. cbn [truth] in E, E1. rewrite <- v_near.
  assert (F1 : finite "not_near" /\ #"not_near" = Rmax #"length" #"near").
  { rewrite E1. destruct u_length as [F _]. destruct (Bltb (e "near") (e "length")) eqn:L.
    - apply lt_true in L; try assumption; try apply f_near. split. exact F. rewrite Rmax_left; lra.
    - apply lt_false in L; try assumption; try apply f_near. split. apply f_near. rewrite Rmax_right; lra. }
  destruct F1 as [F1 V1]. rewrite <- V1, E. destruct (Bltb (e "not_near") (e "far")) eqn:L.
  - apply lt_true in L; try assumption; try apply f_far. split. exact F1. rewrite Rmin_left; lra.
  - apply lt_false in L; try assumption; try apply f_far. split. apply f_far. rewrite Rmin_right; lra.
Qed.
Lemma length_least' : 3.09e-5 <= #"length".
Proof. plane. eapply length_least with (w1 := #"w1") (w2 := #"w2") (w3 := #"w3"); fact. Qed.
Lemma distance_range : Rabs #"diff" <= #"distance" /\ #"distance" <= #"far" /\ (#"distance" = #"far" \/ 3e-5 <=
  #"distance").
Proof.
  rewrite (proj2 v_distance). pose proof length_least'. pose proof bones_apart as B. rewrite v_near in B.
  unfold Rmin, Rmax. repeat destruct (Rle_dec _ _); lra.
Qed.
Lemma u_far : upto 26 (e "far").
Proof. split. apply f_far. plane. pose proof far_positive. rewrite Rabs_right by lra. simpl (bpow _ _). lra. Qed.
Lemma u_diff : upto 26 (e "diff").
Proof. split. apply f_diff. plane. pose proof bones_apart as B. rewrite v_near in B. simpl (bpow _ _). lra. Qed.
Lemma u_distance : upto 26 (e "distance").
Proof. split. apply v_distance. plane. pose proof distance_range. pose proof (Rabs_pos #"diff").
  rewrite Rabs_right by lra. simpl (bpow _ _). lra. Qed.
Lemma v_longer : upto 27 (e "longer") /\ #"longer" = fl32 (#"far" + #"distance"). Proof.
  sum "longer" of u_far u_distance. Qed.
Lemma v_shorter : upto 27 (e "shorter") /\ #"shorter" = fl32 (#"far" - #"distance"). Proof.
  difference "shorter" of u_far u_distance. Qed.
Lemma v_ahead : upto 27 (e "ahead") /\ #"ahead" = fl32 (#"distance" + #"diff"). Proof.
  sum "ahead" of u_distance u_diff. Qed.
Lemma v_behind : upto 27 (e "behind") /\ #"behind" = fl32 (#"distance" - #"diff"). Proof.
  difference "behind" of u_distance u_diff. Qed.
Lemma v_a : upto 54 (e "a") /\ #"a" = fl32 (#"behind" * #"ahead"). Proof. product "a" of v_behind v_ahead. Qed.
Lemma v_b : upto 54 (e "b") /\ #"b" = fl32 (#"shorter" * #"longer"). Proof. product "b" of v_shorter v_longer. Qed.
Lemma v_p : upto 54 (e "p") /\ #"p" = fl32 (#"ahead" * #"longer"). Proof. product "p" of v_ahead v_longer. Qed.
Lemma v_m : upto 54 (e "m") /\ #"m" = fl32 (#"behind" * #"shorter"). Proof. product "m" of v_behind v_shorter. Qed.
Lemma v_sum : upto 55 (e "sum") /\ #"sum" = fl32 (#"a" + #"b"). Proof. sum "sum" of v_a v_b. Qed.
Lemma bones_apart' : 9.9e-10 <= #"far" - Rabs #"diff". Proof. rewrite <- v_near. apply bones_apart. Qed.
Ltac known_triangle := first [apply float_value | exact (proj1 distance_range) | exact (proj1 (proj2 distance_range)) |
  exact (proj2 (proj2 distance_range)) | exact bones_apart'
  | exact (proj2 v_longer) | exact (proj2 v_shorter) | exact (proj2 v_ahead) | exact (proj2 v_behind) | exact (proj2
    v_a) | exact (proj2 v_b) | exact (proj2 v_p) | exact (proj2 v_m) | exact (proj2 v_sum) | lra].
Lemma sum_size : 8e-19 <= #"sum" <= 1.4e15 /\ 7e-16 <= 1 / #"sum" <= 1.3e18.
Proof. plane. split; [eapply sum_range with (far := #"far") (diff := #"diff") (d := #"distance")|eapply inverse_range
  with (far := #"far") (diff := #"diff") (d := #"distance")]; known_triangle. Qed.
Lemma v_per_sum : upto 61 (e "per_sum") /\ #"per_sum" = fl32 (1 / #"sum").
Proof.
  line "per_sum" as E. line "one" as E1. destruct E1 as [F V].
    assert (V1 : #"one" = 1) by (rewrite V; unfold F2R; simpl; lra). rewrite <- V1, E. destruct sum_size as [S1 S2].
  apply div_exact. exact F. lra. lia. rewrite V1, Rabs_right by lra. simpl (bpow _ _). lra.
Qed.
Ltac triangle L := plane; eapply L with (far := #"far") (diff := #"diff") (d := #"distance");
  first [exact (proj2 v_per_sum) | known_triangle].
Lemma v_cos2 : upto 115 (e "cos2") /\ #"cos2" = fl32 (#"a" * #"per_sum"). Proof. product "cos2" of v_a v_per_sum. Qed.
Lemma v_sin2 : upto 115 (e "sin2") /\ #"sin2" = fl32 (#"b" * #"per_sum"). Proof. product "sin2" of v_b v_per_sum. Qed.
Lemma cos2_size : 0 <= #"cos2" <= 1.001 /\ (#"cos2" = 0 \/ 3e-32 <= #"cos2").
Proof. plane. eapply ca_range with (far := #"far") (diff := #"diff") (d := #"distance");
  first [exact (proj2 v_per_sum) | exact (proj2 v_cos2) | known_triangle]. Qed.
Lemma sin2_size : 0 <= #"sin2" <= 1.001 /\ (#"sin2" = 0 \/ 5e-8 <= #"sin2").
Proof. plane. eapply sa_range with (far := #"far") (diff := #"diff") (d := #"distance");
  first [exact (proj2 v_per_sum) | exact (proj2 v_sin2) | known_triangle]. Qed.
Lemma v_cos_half : upto 1 (e "cos_half") /\ #"cos_half" = fl32 (sqrt #"cos2").
Proof. line "cos_half" as E. rewrite E. destruct cos2_size as [C _]. apply root_exact. apply v_cos2. lra. lia.
  simpl (bpow _ _). lra. Qed.
Lemma v_sin_half : upto 1 (e "sin_half") /\ #"sin_half" = fl32 (sqrt #"sin2").
Proof. line "sin_half" as E. rewrite E. destruct sin2_size as [C _]. apply root_exact. apply v_sin2. lra. lia.
  simpl (bpow _ _). lra. Qed.
Lemma v_top : upto 54 (e "top") /\ #"top" = Rmax #"p" #"m".
Proof.
  line "top" as E. cbn [truth] in E. rewrite E. destruct v_p as [[Fp Bp] _]. destruct v_m as [[Fm Bm] _].
    destruct (Bltb (e "m") (e "p")) eqn:L.
  - apply lt_true in L; try assumption. split. now split. rewrite Rmax_left; lra.
  - apply lt_false in L; try assumption. split. now split. rewrite Rmax_right; lra.
Qed.
Lemma v_larger' : upto 115 (e "larger") /\ #"larger" = fl32 (#"top" * #"per_sum"). Proof.
  product "larger" of v_top v_per_sum. Qed.
Lemma larger_size : 3.9e-13 <= #"larger" <= 3.3559e7.
Proof. plane. eapply larger_range with (far := #"far") (diff := #"diff") (d := #"distance");
  first [exact (proj2 v_per_sum) | exact (proj2 v_top) | exact (proj2 v_larger') | known_triangle]. Qed.
Lemma u_larger : upto 26 (e "larger"). Proof. split. apply v_larger'. pose proof larger_size.
  rewrite Rabs_right by lra. simpl (bpow _ _). lra. Qed.
Lemma v_smaller : upto 2 (e "smaller") /\ #"smaller" = fl32 (#"cos_half" * #"sin_half"). Proof.
  product "smaller" of v_cos_half v_sin_half. Qed.
Lemma v_both : upto 55 (e "both") /\ #"both" = fl32 (#"p" + #"m"). Proof. sum "both" of v_p v_m. Qed.
Lemma v_ratio : upto 116 (e "ratio") /\ #"ratio" = fl32 (#"both" * #"per_sum"). Proof.
  product "ratio" of v_both v_per_sum. Qed.
Lemma ratio_size : 7.9e-13 <= #"ratio" <= 3.3559e7.
Proof. plane. eapply ratio_range with (far := #"far") (diff := #"diff") (d := #"distance");
  first [exact (proj2 v_per_sum) | exact (proj2 v_both) | exact (proj2 v_ratio) | known_triangle]. Qed.
Lemma u_ratio : upto 26 (e "ratio"). Proof. split. apply v_ratio. pose proof ratio_size. rewrite Rabs_right by lra.
  simpl (bpow _ _). lra. Qed.
Lemma v_lift2 : upto 52 (e "lift2") /\ #"lift2" = fl32 (#"larger" * #"ratio"). Proof.
  product "lift2" of u_larger u_ratio. Qed.
Lemma lift2_size : 3e-25 <= #"lift2" <= 1.1263e15.
Proof. plane. eapply lift2_range with (far := #"far") (diff := #"diff") (d := #"distance");
  first [exact (proj2 v_per_sum) | exact (proj2 v_top) | exact (proj2 v_larger') | exact (proj2 v_both) | exact (proj2
    v_ratio) | exact (proj2 v_lift2) | known_triangle]. Qed.
Lemma v_cos_lift : upto 55 (e "cos_lift") /\ #"cos_lift" = fl32 (#"p" - #"m"). Proof. difference "cos_lift" of v_p v_m.
  Qed.
Lemma v_lift_side : upto 55 (e "lift_side") /\ #"lift_side" = sg * #"cos_lift". Proof. line "lift_side" as E.
  rewrite E. apply flip_upto. apply v_cos_lift. Qed.
Lemma v_zero : finite "zero" /\ #"zero" = 0. Proof. line "zero" as E. destruct E as [F V]. split. exact F. rewrite V.
  unfold F2R. simpl. lra. Qed.
(* larger_first *)
Lemma v_first : upto 26 (e "first") /\ upto 26 (e "second") /\
  ((0 <= sg * #"cos_lift" /\ #"first" = #"larger" /\ #"second" = #"smaller") \/ (sg * #"cos_lift" < 0 /\ #"first" =
    #"smaller" /\ #"second" = #"larger")).
Proof.
  line "first" as E. line "second" as E1. cbn [truth] in E, E1. rewrite E, E1. destruct v_zero as [Fz Vz].
    destruct v_lift_side as [[Fl _] Vl].
  assert (S : upto 26 (e "smaller")) by (apply upto_le with (1 := proj1 v_smaller); lia). pose proof u_larger as L.
  destruct (Bleb (e "zero") (e "lift_side")) eqn:B.
  - apply le_true in B; try assumption. rewrite Vz, Vl in B. repeat split; try apply L; try apply S. left.
    repeat split; lra.
  - apply le_false in B; try assumption. rewrite Vz, Vl in B. repeat split; try apply L; try apply S. right.
    repeat split; lra.
Qed.
Lemma v_lift_cos : upto 26 (e "lift_cos") /\ #"lift_cos" = sg * #"first". Proof. line "lift_cos" as E. rewrite E.
  apply flip_upto. apply v_first. Qed.
Lemma v_middle_half2 : upto 27 (e "middle_half2") /\ #"middle_half2" = fl32 (#"length" * #"height"). Proof.
  product "middle_half2" of u_length v_height. Qed.
Lemma v_lifted : upto 79 (e "lifted") /\ #"lifted" = fl32 (#"middle_half2" * #"lift2"). Proof.
  product "lifted" of v_middle_half2 v_lift2. Qed.
Lemma v_per_kLeastLift : upto 14 (e "per_kLeastLift") /\ #"per_kLeastLift" = 10000.
Proof. line "per_kLeastLift" as E. destruct E as [F V].
  assert (Q : #"per_kLeastLift" = 10000) by (rewrite V; unfold F2R; simpl; lra). split. split. exact F.
  rewrite Q, Rabs_right by lra. simpl (bpow _ _). lra. exact Q. Qed.
Lemma v_lift_least : upto 93 (e "lift_least") /\ #"lift_least" = fl32 (#"per_kLeastLift" * #"lifted"). Proof.
  product "lift_least" of v_per_kLeastLift v_lifted. Qed.
Lemma middle_size : 9.7e-10 <= #"middle_half2" <= 2.00001 * #"wrist2".
Proof. plane. eapply middle_range with (w1 := #"w1") (w2 := #"w2") (w3 := #"w3");
  first [exact (proj2 v_middle_half2) | fact]. Qed.
(* by `holds`: the lift is not small beside the middle line *)
Lemma lifted_least : 9.9e-14 <= #"middle_half2" * #"lift2".
Proof.
  destruct conditions as [_ [_ [_ C]]]. destruct least as [F V]. line "bones_least" as E. rewrite E in C.
    cbn [truth] in C.
  pose proof (lo_second _ _ _ F f_shortest2 (upto_finite _ _ (proj1 v_lift_least)) C) as L.
    rewrite V, (proj2 v_lift_least), (proj2 v_per_kLeastLift), (proj2 v_lifted) in L.
  pose proof middle_size. pose proof lift2_size. assert (P : 0 <= #"middle_half2" * #"lift2") by (apply Rmult_le_pos;
    lra).
  pose proof (fl_between _ P) as I1. pose proof (fl_pos _ P) as I2.
  pose proof (fl_between (10000 * fl32 (#"middle_half2" * #"lift2")) ltac:(lra)) as I3. lra.
Qed.

(* ---- the scale *)
Lemma bulk W P : 0 <= W -> 0 <= P -> W + P <= 3.5001e7 -> W * (P * P) <= 6.353e21.
Proof.
  intros HW HP H. assert (Q : 0 <= (P - 23334000) * (P - 23334000) * (P + 11667000)) by (apply Rmult_le_pos;
    [apply sqr_pos|lra]).
  assert (W * (P * P) <= (35001000 - P) * (P * P)) by (apply Rmult_le_compat_r; [apply sqr_pos|lra]). lra.
Qed.
Lemma v_half_twist : upto 84 (e "half_twist") /\ #"half_twist" = fl32 (#"middle_half2" * #"twist_len2"). Proof.
  product "half_twist" of v_middle_half2 v_twist_len2. Qed.
Lemma twist_least : 1.89e-25 <= #"twist_len2".
Proof.
  plane. destruct twist_size as [T _]. assert (9.99e-10 * 9.99e-10 <= #"pole1" * #"pole1") by (apply Rmult_le_compat;
    lra). lra.
Qed.
Lemma half_twist_exact : 1.8e-34 <= #"middle_half2" * #"twist_len2" <= 2.581e23.
Proof.
  plane. destruct twist_size as [_ T]. pose proof twist_least. destruct middle_size as [M1 M2]. split.
  - apply Rle_trans with (9.7e-10 * 1.89e-25). lra. apply Rmult_le_compat; lra.
  - pose proof (bulk #"wrist2" #"pole1" ltac:(lra) ltac:(lra) ltac:(lra)) as B.
    assert (#"middle_half2" * #"twist_len2" <= 2.00001 * #"wrist2" * (20.3 * (#"pole1" * #"pole1"))) by (apply
      Rmult_le_compat; lra). lra.
Qed.
Lemma r_half_twist : relative (#"middle_half2" * #"twist_len2"). Proof. apply relative_large. right.
  pose proof half_twist_exact. rewrite Rabs_right; lra. Qed.
Lemma half_twist_near : near 6e-8 #"half_twist" (#"middle_half2" * #"twist_len2").
Proof. rewrite (proj2 v_half_twist). apply near_one. apply r_half_twist. pose proof half_twist_exact. lra. Qed.
Lemma half2_exact : 1.8e-38 <= #"half_twist" * #"lift2" <= 2.91e38.
Proof.
  pose proof (near_bounds _ _ _ half_twist_near) as N. destruct half_twist_exact as [A1 A2].
    destruct lift2_size as [L1 L2]. pose proof lifted_least as LL. pose proof twist_least as TL.
    destruct middle_size as [M _]. split.
  - assert (B : 0.999 * (#"middle_half2" * #"twist_len2") * #"lift2" <= #"half_twist" * #"lift2") by (apply
    Rmult_le_compat_r; lra).
    assert (C : 9.9e-14 * 1.89e-25 <= #"middle_half2" * #"lift2" * #"twist_len2") by (apply Rmult_le_compat; lra). lra.
  - apply Rle_trans with (2.5811e23 * 1.1263e15). apply Rmult_le_compat; lra. lra.
Qed.
Lemma r_half2 : relative (#"half_twist" * #"lift2"). Proof. apply relative_large. right. pose proof half2_exact.
  rewrite Rabs_right; lra. Qed.
Lemma v_half2 : finite "half2" /\ #"half2" = fl32 (#"half_twist" * #"lift2").
Proof. line "half2" as E. rewrite E. pose proof half2_exact. apply finite_within. apply v_half_twist. apply v_lift2.
  rewrite Rabs_right; lra. Qed.
Lemma half2_size : 1.79e-38 <= #"half2" <= 2.92e38.
Proof. pose proof half2_exact. pose proof (near_bounds _ _ _ (near_one _ r_half2 ltac:(lra))) as N.
  rewrite <- (proj2 v_half2) in N. lra. Qed.
Lemma v_root : finite "root" /\ #"root" = fl32 (sqrt #"half2").
Proof.
  line "root" as E. rewrite E. pose proof half2_size. destruct (root_exact (e "half2") 128) as [[F _] V].
    apply v_half2. lra. lia. simpl (bpow _ _). lra. split; assumption.
Qed.
Lemma sqrt_half2 : 1.33e-19 <= sqrt #"half2" <= 1.71e19.
Proof.
  pose proof half2_size. split.
  - rewrite <- (sqrt_square 1.33e-19) by lra. apply sqrt_le_1_alt. lra.
  - rewrite <- (sqrt_square 1.71e19) by lra. apply sqrt_le_1_alt. lra.
Qed.
Lemma r_root : relative (sqrt #"half2"). Proof. apply relative_large. right. pose proof sqrt_half2.
  rewrite Rabs_right; lra. Qed.
Lemma root_size : 1.32e-19 <= #"root" <= 1.72e19.
Proof. pose proof sqrt_half2. pose proof (near_bounds _ _ _ (near_one _ r_root ltac:(lra))) as N.
  rewrite <- (proj2 v_root) in N. lra. Qed.
Lemma v_kRoot : finite "kRoot" /\ #"kRoot" = 11863283 / 16777216.
Proof. line "kRoot" as E. destruct E as [F V]. split. exact F. rewrite V. unfold F2R. simpl. lra. Qed.
Lemma scale_exact : 4e-20 <= 11863283 / 16777216 / #"root" <= 5.4e18.
Proof.
  pose proof root_size as [R1 R2]. assert (I1 : / #"root" <= / 1.32e-19) by (apply Rinv_le_contravar; lra).
    assert (I2 : / 1.72e19 <= / #"root") by (apply Rinv_le_contravar; lra).
  unfold Rdiv at 1 3. split.
  - apply Rle_trans with (11863283 / 16777216 * / 1.72e19). lra. apply Rmult_le_compat_l; lra.
  - apply Rle_trans with (11863283 / 16777216 * / 1.32e-19). apply Rmult_le_compat_l; lra. lra.
Qed.
Lemma r_scale : relative (11863283 / 16777216 / #"root"). Proof. apply relative_large. right. pose proof scale_exact.
  rewrite Rabs_right; lra. Qed.
Lemma v_scale : upto 63 (e "scale") /\ #"scale" = fl32 (11863283 / 16777216 / #"root").
Proof.
  line "scale" as E. rewrite E, <- (proj2 v_kRoot). pose proof root_size. pose proof scale_exact. apply div_exact.
    apply v_kRoot. lra. lia.
  rewrite (proj2 v_kRoot), Rabs_right by lra. simpl (bpow _ _). lra.
Qed.
Lemma scale_positive : 0 < #"scale".
Proof. pose proof scale_exact. pose proof (near_bounds _ _ _ (near_one _ r_scale ltac:(lra))) as N.
  rewrite <- (proj2 v_scale) in N. lra. Qed.

(* ---- the rotor *)
Lemma v_twist : upto 28 (e "t0") /\ upto 28 (e "t3") /\ #"t0" * #"t0" + #"t3" * #"t3" = #"large" * #"large" + #"s" *
  #"s".
Proof.
  line "t0" as E. line "t3" as E1. cbn [truth] in E, E1. rewrite E, E1.
    destruct (Bltb (e "c") (e "zero")); (split; [|split]); try apply u_s; try apply u_large; ring.
Qed.
Lemma u_t0 : upto 28 (e "t0"). Proof. apply v_twist. Qed.
Lemma u_t3 : upto 28 (e "t3"). Proof. apply v_twist. Qed.
Lemma height_pos : 3e-5 <= #"height".
Proof.
  plane. assert (N : near 2.2e-7 #"height" (l + size "w3")) by (eapply height_near with (w1 := #"w1") (w2 := #"w2") (w3
    := #"w3"); fact).
  apply near_bounds in N. pose proof (Rabs_pos #"w3").
  assert (L : 3.1e-5 <= l) by (eapply l_least with (w1 := #"w1") (w2 := #"w2") (w3 := #"w3"); fact). lra.
Qed.
Lemma v_middle3 : upto 14 (e "middle3") /\ #"middle3" = sg * #"height".
Proof.
  line "middle3" as E. rewrite E. destruct (with_sign_upto _ (e "w3") _ (proj1 v_height)) as [U V]. split. exact U.
    rewrite V. pose proof height_pos. rewrite (Rabs_right #"height") by lra. reflexivity.
Qed.
Lemma v_w1t0 : upto 41 (e "w1t0") /\ #"w1t0" = fl32 (#"w1" * #"t0"). Proof. product "w1t0" of u_w1 u_t0. Qed.
Lemma v_w2t3 : upto 41 (e "w2t3") /\ #"w2t3" = fl32 (#"w2" * #"t3"). Proof. product "w2t3" of u_w2 u_t3. Qed.
Lemma v_w2t0 : upto 41 (e "w2t0") /\ #"w2t0" = fl32 (#"w2" * #"t0"). Proof. product "w2t0" of u_w2 u_t0. Qed.
Lemma v_w1t3 : upto 41 (e "w1t3") /\ #"w1t3" = fl32 (#"w1" * #"t3"). Proof. product "w1t3" of u_w1 u_t3. Qed.
Lemma v_gx' : upto 42 (e "gx") /\ #"gx" = fl32 (#"w2t3" + #"w1t0"). Proof. sum "gx" of v_w2t3 v_w1t0. Qed.
Lemma v_gx : upto 42 (e "gx") /\ #"gx" = fl32 (#"w1t0" + #"w2t3"). Proof. rewrite (Rplus_comm #"w1t0"). exact v_gx'.
  Qed.
Lemma v_gy : upto 42 (e "gy") /\ #"gy" = fl32 (#"w2t0" - #"w1t3"). Proof. difference "gy" of v_w2t0 v_w1t3. Qed.
Lemma v_gz : upto 42 (e "gz") /\ #"gz" = fl32 (sg * #"height" * #"t0"). Proof. rewrite <- (proj2 v_middle3).
  product "gz" of v_middle3 u_t0. Qed.
Lemma v_height_t3 : upto 42 (e "height_t3") /\ #"height_t3" = fl32 (#"middle3" * #"t3"). Proof.
  product "height_t3" of v_middle3 u_t3. Qed.
Lemma v_gw : upto 42 (e "gw") /\ #"gw" = fl32 (- (sg * #"height" * #"t3")).
Proof.
  line "gw" as E. rewrite E. destruct (opp_upto _ _ (proj1 v_height_t3)) as [U V]. split. exact U.
    rewrite V, (proj2 v_height_t3), (proj2 v_middle3). symmetry. apply fl_opp.
Qed.
Lemma u_lift_sin : upto 26 (e "second"). Proof. apply v_first. Qed.
Lemma v_gw_cos : upto 68 (e "gw_cos") /\ #"gw_cos" = fl32 (#"gw" * #"lift_cos"). Proof.
  product "gw_cos" of v_gw v_lift_cos. Qed.
Lemma v_gx_sin : upto 68 (e "gx_sin") /\ #"gx_sin" = fl32 (#"gx" * #"second"). Proof.
  product "gx_sin" of v_gx u_lift_sin. Qed.
Lemma v_gx_cos : upto 68 (e "gx_cos") /\ #"gx_cos" = fl32 (#"gx" * #"lift_cos"). Proof.
  product "gx_cos" of v_gx v_lift_cos. Qed.
Lemma v_gw_sin : upto 68 (e "gw_sin") /\ #"gw_sin" = fl32 (#"gw" * #"second"). Proof.
  product "gw_sin" of v_gw u_lift_sin. Qed.
Lemma v_gy_cos : upto 68 (e "gy_cos") /\ #"gy_cos" = fl32 (#"gy" * #"lift_cos"). Proof.
  product "gy_cos" of v_gy v_lift_cos. Qed.
Lemma v_gz_sin : upto 68 (e "gz_sin") /\ #"gz_sin" = fl32 (#"gz" * #"second"). Proof.
  product "gz_sin" of v_gz u_lift_sin. Qed.
Lemma v_gz_cos : upto 68 (e "gz_cos") /\ #"gz_cos" = fl32 (#"gz" * #"lift_cos"). Proof.
  product "gz_cos" of v_gz v_lift_cos. Qed.
Lemma v_gy_sin : upto 68 (e "gy_sin") /\ #"gy_sin" = fl32 (#"gy" * #"second"). Proof.
  product "gy_sin" of v_gy u_lift_sin. Qed.
Lemma v_ew : upto 69 (e "ew") /\ #"ew" = fl32 (#"gw_cos" - #"gx_sin"). Proof. difference "ew" of v_gw_cos v_gx_sin. Qed.
Lemma v_ex : upto 69 (e "ex") /\ #"ex" = fl32 (#"gx_cos" + #"gw_sin"). Proof. rewrite Rplus_comm.
  sum "ex" of v_gw_sin v_gx_cos. Qed.
Lemma v_ey : upto 69 (e "ey") /\ #"ey" = fl32 (#"gy_cos" + #"gz_sin"). Proof. rewrite Rplus_comm.
  sum "ey" of v_gz_sin v_gy_cos. Qed.
Lemma v_ez : upto 69 (e "ez") /\ #"ez" = fl32 (#"gz_cos" - #"gy_sin"). Proof. difference "ez" of v_gz_cos v_gy_sin. Qed.

(* relative errors of the triangle *)
Lemma r_a : relative (#"behind" * #"ahead"). Proof. plane.
  eapply rel_a with (far := #"far") (diff := #"diff") (d := #"distance"); known_triangle. Qed.
Lemma r_b : relative (#"shorter" * #"longer"). Proof. plane.
  eapply rel_b with (far := #"far") (diff := #"diff") (d := #"distance"); known_triangle. Qed.
Lemma r_p : relative (#"ahead" * #"longer"). Proof. plane.
  eapply rel_p with (far := #"far") (diff := #"diff") (d := #"distance"); known_triangle. Qed.
Lemma r_m : relative (#"behind" * #"shorter"). Proof. plane.
  eapply rel_m with (far := #"far") (diff := #"diff") (d := #"distance"); known_triangle. Qed.
Ltac triangle_fact := first [exact (proj2 v_per_sum) | exact (proj2 v_cos2) | exact (proj2 v_sin2) | exact (proj2
  v_cos_half) | exact (proj2 v_sin_half) | exact (proj2 v_top) | exact (proj2 v_larger')
  | exact (proj2 v_both) | exact (proj2 v_ratio) | known_triangle].
Lemma r_cos2 : relative (#"a" * #"per_sum"). Proof. plane.
  eapply rel_ca with (far := #"far") (diff := #"diff") (d := #"distance"); triangle_fact. Qed.
Lemma r_sin2 : relative (#"b" * #"per_sum"). Proof. plane.
  eapply rel_sa with (far := #"far") (diff := #"diff") (d := #"distance"); triangle_fact. Qed.
Lemma r_cos_half : relative (sqrt #"cos2"). Proof. plane.
  eapply ch_facts with (far := #"far") (diff := #"diff") (d := #"distance"); triangle_fact. Qed.
Lemma r_sin_half : relative (sqrt #"sin2"). Proof. plane.
  eapply sh_facts with (far := #"far") (diff := #"diff") (d := #"distance"); triangle_fact. Qed.
Lemma r_larger : relative (#"top" * #"per_sum"). Proof. plane.
  eapply rel_larger with (far := #"far") (diff := #"diff") (d := #"distance"); triangle_fact. Qed.
Lemma r_smaller : relative (#"cos_half" * #"sin_half"). Proof. plane.
  eapply rel_smaller with (far := #"far") (diff := #"diff") (d := #"distance"); triangle_fact. Qed.
Lemma r_ratio : relative (#"both" * #"per_sum"). Proof. plane.
  eapply rel_ratio with (far := #"far") (diff := #"diff") (d := #"distance"); triangle_fact. Qed.
Lemma r_lift2 : relative (#"larger" * #"ratio"). Proof. plane.
  eapply rel_lift2 with (far := #"far") (diff := #"diff") (d := #"distance"); triangle_fact. Qed.
Lemma per_sum_positive : 0 < #"per_sum". Proof. plane. eapply r_pos with (far := #"far") (diff := #"diff") (d :=
  #"distance"); triangle_fact. Qed.
Lemma sides_positive : 0 <= #"longer" /\ 0 <= #"shorter" /\ 0 <= #"ahead" /\ 0 <= #"behind".
Proof.
  rewrite (proj2 v_longer), (proj2 v_shorter), (proj2 v_ahead), (proj2 v_behind).
    destruct distance_range as [D1 [D2 _]]. apply Rabs_le_inv in D1.
  pose proof far_positive. repeat split; apply fl_pos; lra.
Qed.
Lemma lift_near : near 5.967e-7 #"lift2" (#"larger" * #"larger" + #"smaller" * #"smaller").
Proof.
  destruct sides_positive as [P1 [P2 [P3 P4]]].
  pose proof (lift_squares #"longer" #"shorter" #"ahead" #"behind" #"per_sum" P1 P2 P3 P4 per_sum_positive r_a r_b r_p
    r_m) as L.
  rewrite <- (proj2 v_a), <- (proj2 v_b), <- (proj2 v_p), <- (proj2 v_m), <- (proj2 v_cos2), <- (proj2 v_sin2),
    <- (proj2 v_cos_half), <- (proj2 v_sin_half), <- (proj2 v_top),
    <- (proj2 v_larger'), <- (proj2 v_smaller), <- (proj2 v_both), <- (proj2 v_ratio), <- (proj2 v_lift2) in L.
  exact (L r_cos2 r_sin2 r_cos_half r_sin_half r_larger r_smaller r_ratio r_lift2).
Qed.
Lemma side_square : sg * sg = 1. Proof. destruct (sign_of_1 (e "w3")) as [S|S]; unfold sg; rewrite S; ring. Qed.
Lemma lift_norm : #"lift_cos" * #"lift_cos" + #"second" * #"second" = #"larger" * #"larger" + #"smaller" * #"smaller".
Proof.
  rewrite (proj2 v_lift_cos). replace (sg * #"first" * (sg * #"first")) with (sg * sg * (#"first" * #"first")) by ring.
    rewrite side_square.
  destruct v_first as [_ [_ [[_ [-> ->]]|[_ [-> ->]]]]]; ring.
Qed.
Lemma lift_form : exists lc ls, ((#"m" <= #"p" /\ lc = #"larger" /\ ls = #"smaller") \/ (#"p" <= #"m" /\ lc =
  #"smaller" /\ ls = #"larger")) /\ lift_q sg lc ls = q4 #"lift_cos" #"second" 0 0.
Proof.
  rewrite (proj2 v_lift_cos). destruct v_first as [_ [_ C]]. rewrite (proj2 v_cos_lift) in C.
  destruct (relative_difference _ _ (float_value (e "p")) (float_value (e "m"))) as [x [K Q]]. rewrite Q in C.
    apply ok_low in K. rewrite u_val in K.
  assert (A : forall t, 0 <= t * (1 + x) -> 0 <= t).
  { intros t H. destruct (Rle_lt_dec 0 t) as [G|G]; [exact G|exfalso].
    assert (0 < - t * (1 + x)) by (apply Rmult_lt_0_compat; lra). lra. }
  destruct (sign_of_1 (e "w3")) as [S|S]; unfold sg in *; rewrite S in *.
  - exists #"first", #"second". split. 2: unfold lift_q; destruct (Rlt_dec 1 0); [lra|f_equal; ring].
    destruct C as [[C [C1 C2]]|[C [C1 C2]]]; rewrite C1, C2; [left|right]; repeat split.
    + pose proof (A (#"p" - #"m") ltac:(lra)). lra.
    + pose proof (A (#"m" - #"p") ltac:(lra)). lra.
  - exists #"second", #"first". split. 2: unfold lift_q; destruct (Rlt_dec (-1) 0); [f_equal; ring|lra].
    destruct C as [[C [C1 C2]]|[C [C1 C2]]]; rewrite C1, C2; [right|left]; repeat split.
    + pose proof (A (#"m" - #"p") ltac:(lra)). lra.
    + pose proof (A (#"p" - #"m") ltac:(lra)). lra.
Qed.

(* the rotors on the way, and their squared lengths *)
Let mt := qmul (q4 0 #"w1" #"w2" (sg * #"height")) (q4 #"t0" 0 0 #"t3").
Let g := q4 #"gw" #"gx" #"gy" #"gz".
Let gl := qmul g (q4 #"lift_cos" #"second" 0 0).
Let g2 := q4 #"ew" #"ex" #"ey" #"ez".
Let X := #"w1" * #"w1" + #"w2" * #"w2" + #"height" * #"height".
Let T := #"large" * #"large" + #"s" * #"s".
Let N := #"larger" * #"larger" + #"smaller" * #"smaller".
Lemma mt_square : q2n mt = X * T.
Proof.
  unfold mt. rewrite q2n_mul. unfold T, X. destruct v_twist as [_ [_ E]]. rewrite <- E. unfold q2n; cbn [qw qx qy qz].
  replace (sg * #"height" * (sg * #"height")) with (sg * sg * (#"height" * #"height")) by ring. rewrite side_square.
    ring.
Qed.
Lemma X_near : near 3.71e-7 X (2 * (#"length" * #"height")).
Proof.
  plane. assert (L : 3.1e-5 <= l) by (eapply l_least with (w1 := #"w1") (w2 := #"w2") (w3 := #"w3"); fact).
  unfold X. apply middle_near_squares with l (l + size "w3").
  - lra.
  - eapply H_range with (w1 := #"w1") (w2 := #"w2") (w3 := #"w3"); fact.
  - eapply middle_square.
  - eapply length_near with (w1 := #"w1") (w2 := #"w2") (w3 := #"w3"); fact.
  - eapply height_near with (w1 := #"w1") (w2 := #"w2") (w3 := #"w3"); fact.
Qed.
Lemma r_middle : relative (#"length" * #"height"). Proof. plane.
  eapply rel_middle with (w1 := #"w1") (w2 := #"w2") (w3 := #"w3"); fact. Qed.
Lemma length_height : 9e-10 <= #"length" * #"height".
Proof. pose proof length_least'. pose proof height_pos. apply Rle_trans with (3.09e-5 * 3e-5). lra.
  apply Rmult_le_compat; lra. Qed.
Lemma middle_near1 : near 6e-8 #"middle_half2" (#"length" * #"height").
Proof. rewrite (proj2 v_middle_half2). apply near_one. apply r_middle. pose proof length_height. lra. Qed.
Lemma parts_positive : 1.7e-9 <= X /\ 1.8e-25 <= T /\ 1e-25 <= N /\ 1e-38 <= X * T * N.
Proof.
  pose proof length_height as LH. pose proof (near_bounds _ _ _ X_near) as NX.
    pose proof (near_bounds _ _ _ twist_near) as NT. fold T in NT. pose proof (near_bounds _ _ _ lift_near) as NN.
    fold N in NN.
  pose proof (near_bounds _ _ _ middle_near1) as NM. pose proof twist_least. pose proof lift2_size.
    pose proof lifted_least as LL. pose proof middle_size.
  assert (B : 0.99 * #"middle_half2" * (0.99 * #"lift2") <= X * N) by (apply Rmult_le_compat; lra).
  assert (C : 9e-14 * 1.8e-25 <= X * N * T) by (apply Rmult_le_compat; lra). repeat split; lra.
Qed.
Lemma turn_flat : #"w1" * #"w1" + #"w2" * #"w2" <= 1.00001 * (sg * #"height" * (sg * #"height")).
Proof.
  replace (sg * #"height" * (sg * #"height")) with (sg * sg * (#"height" * #"height")) by ring.
    rewrite side_square, Rmult_1_l.
  plane. eapply flat_below with (w1 := #"w1") (w2 := #"w2") (w3 := #"w3"); fact.
Qed.
Lemma mt_least : 1e-60 <= q2n mt.
Proof. rewrite mt_square. destruct parts_positive as [A [B _]]. apply Rle_trans with (1.7e-9 * 1.8e-25). lra.
  apply Rmult_le_compat; lra. Qed.
Lemma g_near : near 2.2033e-7 (q2n g) (q2n mt).
Proof.
  apply q2n_near with (1.8482 * k). unfold k; rewrite u_val; lra. unfold k; rewrite u_val; lra.
  exact (twist_product _ _ _ _ _ _ _ _ _ _ _ _ _ turn_flat (proj2 v_w1t0) (proj2 v_w2t3) (proj2 v_gx) (proj2 v_w2t0)
    (proj2 v_w1t3) (proj2 v_gy) (proj2 v_gz) (proj2 v_gw) mt_least).
Qed.
Lemma gl_square : q2n gl = q2n g * N.
Proof. unfold gl. rewrite q2n_mul. unfold N. rewrite <- lift_norm. f_equal. unfold q2n; simpl; ring. Qed.
Lemma gl_near : near 2.2034e-7 (q2n gl) (X * T * N).
Proof.
  rewrite gl_square, <- mt_square. destruct parts_positive as [_ [_ [P _]]]. apply near_mul with 2.2033e-7 0; try lra.
    apply q2n_pos. apply g_near. apply near_refl.
Qed.
Lemma gl_least : 1e-60 <= q2n gl.
Proof. pose proof (near_bounds _ _ _ gl_near). destruct parts_positive as [_ [_ [_ P]]]. lra. Qed.
Lemma g2_near : near 5.0821e-7 (q2n g2) (X * T * N).
Proof.
  destruct parts_positive as [_ [_ [_ P]]]. apply near_trans with 2.8786e-7 2.2034e-7 (q2n gl); try lra;
    [|exact gl_near].
  apply q2n_near with (2.4147 * k). unfold k; rewrite u_val; lra. unfold k; rewrite u_val; lra.
  exact (lift_product g #"lift_cos" #"second" _ _ _ _ _ _ _ _ _ _ _ _ (proj2 v_gw_cos) (proj2 v_gx_sin) (proj2 v_ew)
    (proj2 v_gx_cos) (proj2 v_gw_sin) (proj2 v_ex)
    (proj2 v_gy_cos) (proj2 v_gz_sin) (proj2 v_ey) (proj2 v_gz_cos) (proj2 v_gy_sin) (proj2 v_ez) gl_least).
Qed.
Lemma scaled_near : near 2.048e-6 (q2n (qscale #"scale" g2)) 1.
Proof.
  destruct parts_positive as [P1 [P2 [P3 _]]]. pose proof length_height.
  eapply norm_before with (X := X) (T := T) (N := N) (height_length := #"length" * #"height") (middle :=
    #"middle_half2") (twist2 := #"twist_len2") (lift2 := #"lift2");
    first [exact X_near | exact middle_near1 | exact twist_near | exact lift_near | exact r_half_twist | exact (proj2
      v_half_twist) | exact r_half2 | exact (proj2 v_half2)
      | exact r_root | exact (proj2 v_root) | exact r_scale | exact (proj2 v_scale) | exact g2_near | lra].
Qed.
Lemma scaled_part' t : t * t <= q2n (qscale #"scale" g2) -> Rabs t <= bpow radix2 1.
Proof. intro H. pose proof (near_bounds _ _ _ scaled_near). apply sqr_le_abs. simpl; lra. simpl (bpow _ _). lra. Qed.
Ltac rotor_part name other := let E := fresh "E" in line name as E; rewrite E; apply mul_exact;
  [apply v_scale|apply other|lia|apply scaled_part'; unfold g2, qscale, q2n; cbn [qw qx qy qz];
  pose proof (sqr_pos (#"scale" * #"ew")); pose proof (sqr_pos (#"scale" * #"ex"));
    pose proof (sqr_pos (#"scale" * #"ey")); pose proof (sqr_pos (#"scale" * #"ez")); lra].
Lemma v_qw : upto 1 (e "qw") /\ #"qw" = fl32 (#"scale" * #"ew"). Proof. rotor_part "qw" v_ew. Qed.
Lemma v_qx : upto 1 (e "qx") /\ #"qx" = fl32 (#"scale" * #"ex"). Proof. rotor_part "qx" v_ex. Qed.
Lemma v_qy : upto 1 (e "qy") /\ #"qy" = fl32 (#"scale" * #"ey"). Proof. rotor_part "qy" v_ey. Qed.
Lemma v_qz : upto 1 (e "qz") /\ #"qz" = fl32 (#"scale" * #"ez"). Proof. rotor_part "qz" v_ez. Qed.
Let shoulder := q4 #"qw" #"qx" #"qy" #"qz".
Lemma scaled_least : 1e-60 <= q2n (qscale #"scale" g2). Proof. pose proof (near_bounds _ _ _ scaled_near). lra. Qed.

Lemma rotor_length : Rabs (qnorm shoulder - 1) <= 1.1e-6.
Proof.
  destruct parts_positive as [P1 [P2 [P3 _]]]. pose proof length_height.
  eapply unit_length with (X := X) (T := T) (N := N) (height_length := #"length" * #"height") (middle :=
    #"middle_half2") (twist2 := #"twist_len2") (lift2 := #"lift2") (g2 := g2) (half := #"half_twist") (half2 :=
    #"half2") (root := #"root") (scale := #"scale");
    first [exact X_near | exact middle_near1 | exact twist_near | exact lift_near | exact r_half_twist | exact (proj2
      v_half_twist) | exact r_half2 | exact (proj2 v_half2)
      | exact r_root | exact (proj2 v_root) | exact r_scale | exact (proj2 v_scale) | exact g2_near
      | exact (scaled #"scale" g2 #"qw" #"qx" #"qy" #"qz" (proj2 v_qw) (proj2 v_qx) (proj2 v_qy) (proj2 v_qz)
        scaled_least) | lra].
Qed.
Lemma half_square x y : 0 <= x * y -> relative (x * y) -> relative (sqrt (fl32 (x * y))) ->
  near 1.78817e-7 (fl32 (sqrt (fl32 (x * y))) * fl32 (sqrt (fl32 (x * y)))) (x * y).
Proof.
  intros P R1 R2. pose proof (fl_pos _ P) as Q. apply near_trans with 1.19211e-7 5.9605e-8 (fl32 (x * y)); try lra;
    [|now apply near_u].
  pose proof (near_u2 _ (sqrt (fl32 (x * y))) R2 (sqrt_pos _) eq_refl) as S. rewrite (sqrt_sqrt _ Q) in S. exact S.
Qed.
Lemma elbow_length : Rabs (#"cos_half" * #"cos_half" + #"sin_half" * #"sin_half" - 1) <= 2.985e-7.
Proof.
  destruct sides_positive as [P1 [P2 [P3 P4]]]. pose proof per_sum_positive as P5. destruct sum_size as [S1 S2].
  assert (Qa : 0 <= #"a") by (rewrite (proj2 v_a); apply fl_pos; now apply Rmult_le_pos).
    assert (Qb : 0 <= #"b") by (rewrite (proj2 v_b); apply fl_pos; now apply Rmult_le_pos).
  assert (A1 : near 1.78817e-7 (#"cos_half" * #"cos_half") (#"a" * #"per_sum")).
  { rewrite (proj2 v_cos_half). rewrite (proj2 v_cos2). apply half_square. apply Rmult_le_pos; lra. apply r_cos2.
    rewrite <- (proj2 v_cos2). apply r_cos_half. }
  assert (A2 : near 1.78817e-7 (#"sin_half" * #"sin_half") (#"b" * #"per_sum")).
  { rewrite (proj2 v_sin_half). rewrite (proj2 v_sin2). apply half_square. apply Rmult_le_pos; lra. apply r_sin2.
    rewrite <- (proj2 v_sin2). apply r_sin_half. }
  assert (B : near 5.9605e-8 #"sum" (#"a" + #"b")) by (rewrite (proj2 v_sum); apply near_u; [apply relative_sum;
    apply float_value|lra]).
  apply (near_sym _ 5.9606e-8) in B; try lra.
  assert (C : near 5.9605e-8 #"per_sum" (1 / #"sum")) by (rewrite (proj2 v_per_sum); apply near_u;
    [apply relative_large; right; rewrite Rabs_right; lra|lra]).
  pose proof (near_mul 5.9606e-8 5.9605e-8 1.19213e-7 (#"a" + #"b") #"sum" #"per_sum" (1 / #"sum") ltac:(lra)
    ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) B C) as D. replace (#"sum" * (1 / #"sum")) with 1 in D by (field; lra).
  pose proof (near_add _ _ _ _ _ A1 A2) as E. replace (#"a" * #"per_sum" + #"b" * #"per_sum") with ((#"a" + #"b") *
    #"per_sum") in E by ring.
  pose proof (near_trans 1.78817e-7 1.19213e-7 2.985e-7 (#"cos_half" * #"cos_half" + #"sin_half" * #"sin_half") ((#"a"
    + #"b") * #"per_sum") 1 ltac:(lra) ltac:(lra) ltac:(lra) E D) as F. unfold near in F. lra.
Qed.

(* ---- nothing overflows *)
Lemma f_not_near : finite "not_near".
Proof. line "not_near" as E. rewrite E. match goal with |- context [if ?c then _ else _] => destruct c end.
  exact (upto_finite _ _ u_length). apply f_near. Qed.
Lemma f_lesser : finite "lesser".
Proof. line "lesser" as E. rewrite E. match goal with |- context [if ?c then _ else _] => destruct c end.
  apply f_wrist2. apply f_pole1. Qed.
Lemma f_bones_least : finite "bones_least".
Proof. line "bones_least" as E. rewrite E. match goal with |- context [if ?c then _ else _] => destruct c end.
  apply f_shortest2. exact (upto_finite _ _ (proj1 v_lift_least)). Qed.
Lemma f_one : finite "one". Proof. line "one" as E. apply E. Qed.
Lemma f_abs n m : e n = Babs (e m) -> finite m -> finite n. Proof. intros -> F. now rewrite is_finite_Babs. Qed.
Lemma f_abs_p1 : finite "abs_p1". Proof. line "abs_p1" as E. exact (f_abs _ _ E i_p1). Qed.
Lemma f_abs_p2 : finite "abs_p2". Proof. line "abs_p2" as E. exact (f_abs _ _ E i_p2). Qed.
Lemma f_abs_p3 : finite "abs_p3". Proof. line "abs_p3" as E. exact (f_abs _ _ E i_p3). Qed.
Lemma all_finite : Forall (fun row => is_finite (e (fst row)) = true) program.
Proof.
  unfold program. repeat apply Forall_cons; cbn [fst].
  all: [> exact (proj1 f_w11) | exact (proj2 f_w11) | exact (proj1 f_w12) | exact (proj2 f_w12) | exact f_wrist2 |
    exact (upto_finite _ _ u_length)
     | exact (proj1 v_abs_w3) | exact (upto_finite _ _ (proj1 v_height)) | exact (upto_finite _ _ (proj1 v_p2w1))
     | exact (upto_finite _ _ (proj1 v_p1w2)) | exact (upto_finite _ _ (proj1 v_nz)) | exact (upto_finite _ _ (proj1
       v_p1w3))
     | exact (upto_finite _ _ (proj1 v_p3w1)) | exact (upto_finite _ _ (proj1 v_ny)) | exact (upto_finite _ _ (proj1
       v_p3w2))
     | exact (upto_finite _ _ (proj1 v_p2w3)) | exact (upto_finite _ _ (proj1 v_nx)) | exact (upto_finite _ _ (proj1
       v_nxx))
     | exact (upto_finite _ _ (proj1 v_nyy)) | exact (upto_finite _ _ (proj1 v_nxy)) | exact (upto_finite _ _ (proj1
       v_nzz))
     | exact (upto_finite _ _ (proj1 v_normal2)) | exact (upto_finite _ _ (proj1 v_normal_length)) | exact (upto_finite
       _ _ (proj1 v_per))
     | exact f_abs_p1 | exact f_abs_p2 | exact f_p12 | exact f_abs_p3 | exact (upto_finite _ _ u_pole1) | exact (proj1
       least) | exact f_lesser
     | exact f_wrist_pole | exact (upto_finite _ _ u_far) | exact f_total | exact (proj1 most) | exact (upto_finite _ _
       (proj1 v_length_pole))
     | exact (upto_finite _ _ (proj1 v_kPoleOff)) | exact (upto_finite _ _ (proj1 v_off)) | exact (upto_finite _ _
       u_diff) | exact f_near
     | exact f_not_near | exact (upto_finite _ _ u_distance) | exact (upto_finite _ _ (proj1 v_longer)) | exact
       (upto_finite _ _ (proj1 v_shorter))
     | exact (upto_finite _ _ (proj1 v_ahead)) | exact (upto_finite _ _ (proj1 v_behind)) | exact (upto_finite _ _
       (proj1 v_a))
     | exact (upto_finite _ _ (proj1 v_b)) | exact (upto_finite _ _ (proj1 v_p)) | exact (upto_finite _ _ (proj1 v_m))
     | exact (upto_finite _ _ (proj1 v_sum)) | exact f_one | exact (upto_finite _ _ (proj1 v_per_sum)) | exact
       (upto_finite _ _ (proj1 v_cos2))
     | exact (upto_finite _ _ (proj1 v_cos_half)) | exact (upto_finite _ _ (proj1 v_sin2)) | exact (upto_finite _ _
       (proj1 v_sin_half))
     | exact (upto_finite _ _ (proj1 v_top)) | exact (upto_finite _ _ u_larger) | exact (upto_finite _ _ (proj1
       v_smaller))
     | exact (upto_finite _ _ (proj1 v_both)) | exact (upto_finite _ _ u_ratio) | exact (upto_finite _ _ (proj1
       v_lift2))
     | exact (upto_finite _ _ (proj1 v_cos_lift)) | exact (proj1 v_zero) | exact (upto_finite _ _ (proj1 v_lift_side))
     | exact (upto_finite _ _ (proj1 v_first)) | exact (upto_finite _ _ u_lift_sin) | exact (upto_finite _ _ (proj1
       v_lift_cos))
     | exact f_shortest2 | exact (upto_finite _ _ (proj1 v_middle_half2)) | exact (upto_finite _ _ (proj1 v_lifted))
     | exact (upto_finite _ _ (proj1 v_per_kLeastLift)) | exact (upto_finite _ _ (proj1 v_lift_least)) | exact
       f_bones_least
     | exact (upto_finite _ _ (proj1 v_middle3)) | exact (upto_finite _ _ (proj1 v_mx)) | exact (upto_finite _ _ (proj1
       v_my))
     | exact (upto_finite _ _ (proj1 v_mz)) | exact (upto_finite _ _ (proj1 v_along)) | exact (upto_finite _ _ (proj1
       v_hx))
     | exact (upto_finite _ _ (proj1 v_along1)) | exact (upto_finite _ _ (proj1 v_c)) | exact (upto_finite _ _ (proj1
       v_hy))
     | exact (upto_finite _ _ (proj1 v_along2)) | exact (upto_finite _ _ u_s) | exact (upto_finite _ _ (proj1
       v_per_normal))
     | exact (upto_finite _ _ (proj1 v_spread)) | exact (upto_finite _ _ (proj1 v_abs_c)) | exact (upto_finite _ _
       u_large)
     | exact (upto_finite _ _ u_t3) | exact (upto_finite _ _ u_t0) | exact (upto_finite _ _ (proj1 v_w1t0))
     | exact (upto_finite _ _ (proj1 v_w2t3)) | exact (upto_finite _ _ (proj1 v_gx)) | exact (upto_finite _ _ (proj1
       v_w2t0))
     | exact (upto_finite _ _ (proj1 v_w1t3)) | exact (upto_finite _ _ (proj1 v_gy)) | exact (upto_finite _ _ (proj1
       v_gz))
     | exact (upto_finite _ _ (proj1 v_height_t3)) | exact (upto_finite _ _ (proj1 v_gw)) | exact (upto_finite _ _
       (proj1 v_large_large))
     | exact (upto_finite _ _ (proj1 v_ss)) | exact (upto_finite _ _ (proj1 v_twist_len2)) | exact (upto_finite _ _
       (proj1 v_half_twist))
     | exact (proj1 v_half2) | exact (proj1 v_root) | exact (proj1 v_kRoot) | exact (upto_finite _ _ (proj1 v_scale))
     | exact (upto_finite _ _ (proj1 v_gw_cos)) | exact (upto_finite _ _ (proj1 v_gx_sin)) | exact (upto_finite _ _
       (proj1 v_ew))
     | exact (upto_finite _ _ (proj1 v_gx_cos)) | exact (upto_finite _ _ (proj1 v_gw_sin)) | exact (upto_finite _ _
       (proj1 v_ex))
     | exact (upto_finite _ _ (proj1 v_gy_cos)) | exact (upto_finite _ _ (proj1 v_gz_sin)) | exact (upto_finite _ _
       (proj1 v_ey))
     | exact (upto_finite _ _ (proj1 v_gz_cos)) | exact (upto_finite _ _ (proj1 v_gy_sin)) | exact (upto_finite _ _
       (proj1 v_ez))
     | exact (upto_finite _ _ (proj1 v_qw)) | exact (upto_finite _ _ (proj1 v_qx)) | exact (upto_finite _ _ (proj1
       v_qy))
     | exact (upto_finite _ _ (proj1 v_qz)) | exact (Forall_nil _)].
Qed.

(* ---- the theorem *)
Lemma side_w3 : sg * #"w3" = size "w3". Proof. apply sign_of_abs, i_w3. Qed.
Lemma v_height' : #"height" = fl32 (#"length" + sg * #"w3"). Proof. rewrite side_w3. apply v_height. Qed.
Lemma r_height : relative (#"length" + sg * #"w3"). Proof. rewrite side_w3, <- (proj2 v_abs_w3).
  apply relative_sum; apply float_value. Qed.
Lemma v_larger : #"larger" = fl32 (Rmax #"p" #"m" * #"per_sum"). Proof. rewrite <- (proj2 v_top). apply v_larger'. Qed.
Lemma r_larger' : relative (Rmax #"p" #"m" * #"per_sum"). Proof. rewrite <- (proj2 v_top). apply r_larger. Qed.
Lemma twist_positive : 0 < #"t0" * #"t0" + #"t3" * #"t3".
Proof. rewrite (proj2 (proj2 v_twist)). pose proof parts_positive. fold T. lra. Qed.
Lemma diff_below : Rabs #"diff" < #"far". Proof. pose proof bones_apart'. lra. Qed.
Lemma side_not_negative : 0 <= sg * #"w3". Proof. rewrite side_w3. apply Rabs_pos. Qed.
Lemma wrist_bound : vnorm (vsub (wrist_fk shoulder #"cos_half" #"sin_half" #"upper" #"fore") (vscale (Rmin (Rmax l
  (Rabs (#"upper" - #"fore"))) (#"upper" + #"fore") / l) (v3 #"w1" #"w2" #"w3")))
  <= 1.59e-6 * (#"upper" + #"fore").
Proof.
  destruct lift_form as [lc [ls [C F]]]. destruct bones_positive as [B1 B2].
    assert (L : 1e-5 <= l) by (pose proof l_most; lra).
  pose proof (wrist_rounded #"w1" #"w2" #"w3" #"upper" #"fore" sg #"t0" #"t3" #"scale" #"w11" #"w22" #"w12" #"w33"
    #"wrist2" #"length" #"height" #"far" #"diff" #"distance"
    #"longer" #"shorter" #"ahead" #"behind" #"a" #"b" #"p" #"m" #"per_sum" #"cos2" #"sin2" #"cos_half" #"sin_half"
      #"larger" #"smaller" lc ls #"lift_cos" #"second"
    #"w1t0" #"w2t3" #"gx" #"w2t0" #"w1t3" #"gy" #"gz" #"gw" #"gw_cos" #"gx_sin" #"gx_cos" #"gw_sin" #"gy_cos" #"gz_sin"
      #"gz_cos" #"gy_sin" #"ew" #"ex" #"ey" #"ez"
    #"qw" #"qx" #"qy" #"qz" B1 B2 L (sign_of_1 (e "w3")) side_not_negative
    v_w11 v_w22 v_w12 v_w33 v_wrist2 (proj2 v_length) v_height' v_far v_diff diff_below (proj2 v_distance)
    (proj2 v_longer) (proj2 v_shorter) (proj2 v_ahead) (proj2 v_behind) (proj2 v_a) (proj2 v_b) (proj2 v_p) (proj2 v_m)
      per_sum_positive
    (proj2 v_cos2) (proj2 v_sin2) (proj2 v_cos_half) (proj2 v_sin_half) v_larger (proj2 v_smaller)
    r_height (relative_sum _ _ (float_value _) (float_value _)) (relative_difference _ _ (float_value _) (float_value
      _)) (relative_sum _ _ (float_value _) (float_value _))
    (relative_difference _ _ (float_value _) (float_value _)) (relative_sum _ _ (float_value _) (float_value _))
      (relative_difference _ _ (float_value _) (float_value _))
    r_a r_b r_p r_m r_cos2 r_sin2 r_cos_half r_sin_half r_larger' r_smaller C F twist_positive scale_positive
    (proj2 v_w1t0) (proj2 v_w2t3) (proj2 v_gx) (proj2 v_w2t0) (proj2 v_w1t3) (proj2 v_gy) (proj2 v_gz) (proj2 v_gw)
    (proj2 v_gw_cos) (proj2 v_gx_sin) (proj2 v_ew) (proj2 v_gx_cos) (proj2 v_gw_sin) (proj2 v_ex) (proj2 v_gy_cos)
      (proj2 v_gz_sin) (proj2 v_ey) (proj2 v_gz_cos) (proj2 v_gy_sin) (proj2 v_ez)
    (proj2 v_qw) (proj2 v_qx) (proj2 v_qy) (proj2 v_qz) mt_least gl_least scaled_least turn_flat) as W.
  exact W.
Qed.
End Holds.
