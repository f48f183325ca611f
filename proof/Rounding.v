(* SPDX-License-Identifier: MIT *)
(* Rounding to binary32 (nearest even, gradual underflow, no largest number), and where it has a relative error alone.
  *)
From Coq Require Import Reals Lra Psatz ZArith.
From Flocq Require Import Core Relative Plus_error.
From Swivel Require Import Wrist.
Open Scope R_scope.

Notation fexp := (FLT_exp (-149) 24).
Global Instance prec24 : Prec_gt_0 24 := eq_refl.
Definition fl32 := round radix2 fexp ZnearestE.
Definition is_float x := generic_format radix2 fexp x.

(* In general x is rounded to x (1 + e) + h, where h is there for underflow. *)
Definition eta := 1e-45.  (* above 2^-150 *)
Lemma fl32_ok x : exists e h, ok e /\ Rabs h <= eta /\ fl32 x = x * (1 + e) + h.
Proof.
  destruct (error_N_FLT radix2 (-149) 24 ltac:(reflexivity) (fun x => negb (Z.even x)) x) as [e [h [He [Hh [_ E]]]]].
  exists e, h. split; [|split; [|exact E]].
  - unfold ok, u. eapply Rle_trans. exact He. simpl. lra.
  - unfold eta. eapply Rle_trans. exact Hh. simpl. lra.
Qed.


(* Without the error h: sums of floats, and results of a size above 2^-126 or zero. *)
Definition relative x := exists e, ok e /\ fl32 x = x * (1 + e).
Lemma relative_large x : x = 0 \/ 1.18e-38 <= Rabs x -> relative x.
Proof.
  intros [->|H].
  - exists 0. split. unfold ok. rewrite Rabs_R0, u_val. lra. unfold fl32.
    rewrite round_0 by auto with typeclass_instances. ring.
  - destruct (relative_error_N_FLT_ex radix2 (-149) 24 ltac:(reflexivity) (fun x => negb (Z.even x)) x) as [e [B E]].
    eapply Rle_trans. 2: exact H. simpl. lra.
    exists e. split; [|exact E]. unfold ok, u. eapply Rle_trans. exact B. simpl. lra.
Qed.
Lemma relative_sum x y : is_float x -> is_float y -> relative (x + y).
Proof.
  intros Fx Fy. destruct (@FLT_plus_error_N_ex radix2 (-149) 24 ltac:(reflexivity) (fun x => negb (Z.even x)) x y Fx
    Fy) as [e [B E]].
  exists e. split; [|exact E]. unfold ok, u. eapply Rle_trans. exact B. unfold u_ro. simpl. lra.
Qed.
Lemma relative_difference x y : is_float x -> is_float y -> relative (x - y).
Proof. intros Fx Fy. apply relative_sum. exact Fx. apply generic_format_opp. exact Fy. Qed.

Lemma float_fl x : is_float (fl32 x).
Proof. unfold is_float, fl32. apply generic_format_round; auto with typeclass_instances. Qed.
Lemma fl_le x y : x <= y -> fl32 x <= fl32 y.
Proof. apply round_le; auto with typeclass_instances. Qed.
Lemma fl_float x : is_float x -> fl32 x = x.
Proof. apply round_generic; auto with typeclass_instances. Qed.
Lemma fl_opp x : fl32 (- x) = - fl32 x.
Proof. apply round_NE_opp. Qed.
Lemma float_0 : is_float 0.
Proof. apply generic_format_0. Qed.
Lemma fl_0 : fl32 0 = 0.
Proof. apply fl_float, float_0. Qed.
Lemma fl_pos x : 0 <= x -> 0 <= fl32 x.
Proof. intro H. rewrite <- fl_0. now apply fl_le. Qed.
Lemma float_bpow n : (-149 <= n)%Z -> is_float (bpow radix2 n).
Proof. intro H. apply generic_format_bpow. unfold FLT_exp. lia. Qed.
Lemma fl_abs_le x n : (-149 <= n)%Z -> Rabs x <= bpow radix2 n -> Rabs (fl32 x) <= bpow radix2 n.
Proof.
  intros Hn H. apply abs_round_le_generic; auto with typeclass_instances. now apply float_bpow.
Qed.

(* Two different floats are at least 2^-24 of the larger apart, up to a part in 10^7. *)
Lemma float_gap x y : is_float x -> is_float y -> 0 <= y -> y < x -> 5.96046e-8 * x <= x - y.
Proof.
  intros Fx Fy Hy H. pose proof (succ_le_lt radix2 fexp y x Fy Fx H) as S. rewrite succ_eq_pos in S by exact Hy.
  pose proof (ulp_FLT_gt radix2 (-149) 24 y) as U. rewrite Rabs_right in U by lra.
  simpl (bpow _ _) in U. lra.
Qed.
